#pragma once

#include <functional>
#include <vector>

#include "analysis/blind/trial.hpp"
#include "core/sim/simulate.hpp"

namespace drift::blind {

/// Everything that makes one recording: the truth and its numbers, the test, and what acts on
/// platform and instruments besides.
struct World {
  TruthSpec truth;
  TruthDraw draw;
  Timeline timeline;
  Readout readout;                               ///< as declared
  double acc_factor = 1.0, gimbal_factor = 1.0;  ///< true noise over declared
  Mat3X disturbance;   ///< further rate of the platform in each interval, platform axes [rad/s]; or
                       ///< empty
  Mat3X acc_error;     ///< added to the accelerometers [g]; or empty
  Mat3X gimbal_error;  ///< added to the resolvers [rad]; or empty

  Eigen::Index intervals() const { return static_cast<Eigen::Index>(timeline.intervals.size()); }
  /// Adds to one of the three above, which is made first where it is empty.
  static void add(Mat3X& to, const Mat3X& what, double factor) {
    if (to.cols() == 0) to = Mat3X::Zero(3, what.cols());
    to += factor * what;
  }
};

/// Measurements of a world without sensor noise, and the platform's motion. The servo is replaced
/// by eq. (6), which it closes like (physics.md 1.5): this is for sizes and signatures, not for
/// recordings.
Simulation simulate_clean(const World& world, std::uint64_t seed, std::uint64_t run);

/// The measurements as recorded: full dynamics, noise and all. InputError (self_check) if the
/// integration fails.
Simulation simulate_recorded(const World& world, std::uint64_t seed, std::uint64_t run);

/// Something that can be hidden in a world, with a strength of its own.
struct Source {
  HiddenEffect effect;                                             ///< without size and numbers
  double first = 1.0;                                              ///< a strength to begin with
  double most = 1.0;                                               ///< strongest that is plausible
  std::function<void(World&, double)> put;                         ///< adds it with a strength
  std::function<std::vector<HiddenParameter>(double)> parameters;  ///< its numbers at a strength
};

}  // namespace drift::blind
