#pragma once

#include "core/estimate/sequential/covariance.hpp"

namespace drift {

/// What the innovations of a filter add up to.
// NOLINTNEXTLINE(bugprone-reserved-identifier): __i0 is a name of clang's own
class InnovationSums {
 public:
  enum Channel { accelerometers = 0, gimbals = 1 };

  double nis = 0.0;         ///< sum of the normalised innovations squared
  std::size_t scalars = 0;  ///< measured scalars it sums over

  void add(const Covariance::Update& update, Channel channel) {
    nis += update.nis;
    scalars += static_cast<std::size_t>(update.scalars);
    Vec3& before = white_before_[channel];
    for (int a = 0; a < 3; ++a)
      if (before[a] != 0.0 && update.white[a] != 0.0) {
        lagged_ += before[a] * update.white[a];
        ++pairs_;
      }
    before = update.white;
  }

  /// Correlation of whitened innovations of one channel, one sample apart: 0 on average for a right
  /// model, with standard deviation 1 / sqrt(scalars) or a little more (physics.md 5.6).
  double lag1() const {
    return pairs_ > 0 && nis > 0.0
               ? lagged_ / nis * static_cast<double>(scalars) / static_cast<double>(pairs_)
               : 0.0;
  }

 private:
  double lagged_ = 0.0;
  std::size_t pairs_ = 0;
  Vec3 white_before_[2] = {Vec3::Zero(), Vec3::Zero()};
};

}  // namespace drift
