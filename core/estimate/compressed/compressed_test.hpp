#pragma once

#include <array>
#include <vector>

#include "core/estimate/compressed/polynomial_projection.hpp"
#include "core/estimate/measured_test.hpp"

namespace drift {

/// What three axes of one kind have read along a stretch, and how it follows from what they read at
/// its nodes.
struct StretchChannel {
  struct Axis {
    MatX of_nodes;  ///< shape (rows, nodes) [1/unit]
    VecX measured;  ///< of as many rows, whitened
  };
  std::array<Axis, 3> axes;
  Vec3 reference = Vec3::Zero();  ///< what readings count from

  Eigen::Index rows() const {
    return axes[0].measured.size() + axes[1].measured.size() + axes[2].measured.size();
  }
};

/// The readings of a stretch in which one thing is commanded.
struct StretchReadings {
  StretchChannel accelerometers;  ///< means [g]
  StretchChannel gimbals;         ///< angles at the ends of samples [rad]
  MatX integral;                  ///< from the beginning to each node, of values there [s]
};

/// A test whose long stretches of constant command are one interval each, read by projections of
/// all their samples on a few polynomials of the time. Along such a stretch all that is predicted
/// turns with the Earth and the command, by an angle a that is known: coefficients of degree k fall
/// like (a / 4)^k / k!, and as many are kept as exceed 1e-10, and two. What is left of the readings
/// does not depend on the model: a constant of the cost.
/// Exact where noise is white and the model's terms ask for attitude and command alone.
class CompressedTest {
 public:
  /// The test and its readout must outlive it. leave: first intervals of stretches that stay as
  /// they are.
  explicit CompressedTest(const MeasuredTest& test, const std::vector<std::size_t>& leave = {});
  CompressedTest(const CompressedTest&) = delete;
  CompressedTest& operator=(const CompressedTest&) = delete;

  /// Whether anything was taken together.
  bool any() const { return stretches_ > 0; }
  /// With the stretches as intervals, in which nothing else is measured.
  MeasuredTest test() const { return {timeline_, readout_, measured_}; }
  /// The readings of interval i if it is a stretch, else null.
  const StretchReadings* readings(std::size_t i) const {
    return of_interval_[i] < 0 ? nullptr : &readings_[static_cast<std::size_t>(of_interval_[i])];
  }
  /// The first of the intervals of the test that interval i stands for.
  std::size_t first(std::size_t i) const { return first_[i]; }
  /// Sum of squares of what no polynomial reaches.
  double left_over() const { return left_over_; }

 private:
  void take_alone(const MeasuredTest& test, std::size_t i);
  void take_together(const MeasuredTest& test, std::size_t first, std::size_t end, int substeps);
  template <class Noise>
  StretchChannel read(const MeasuredTest& test, std::size_t first, std::size_t end, Reading what,
                      const Mat3X& measured, const Noise& noise, const MatX& fit);

  Readout readout_;
  Timeline timeline_;
  Measurements measured_;
  std::vector<std::size_t> first_;
  std::vector<int> of_interval_;
  std::vector<StretchReadings> readings_;
  std::size_t stretches_ = 0;
  double left_over_ = 0.0;
};

}  // namespace drift
