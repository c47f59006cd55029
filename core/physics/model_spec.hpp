#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/physics/drift_model.hpp"
#include "core/physics/servo_options.hpp"

namespace drift {

/// White rate noise and its integral, driving the platform.
struct ProcessNoise {
  double angle_random_walk = 0.0;  ///< of each gyro [rad/sqrt(s)]
  double drift_random_walk = 0.0;  ///< of D_F of each gyro [rad/s/sqrt(s)]
  bool any() const { return angle_random_walk > 0.0 || drift_random_walk > 0.0; }
  bool operator==(const ProcessNoise&) const = default;
};

/// A drift model together with what is believed of its parameters.
struct ModelSpec {
  Coupling coupling = Coupling::eq5;
  ParamMask active;                                     ///< parameters in play; the others are zero
  std::array<Prior, TermLibrary::num_params> priors{};  ///< SI; used where active
  double initial_attitude =
      200.0 * detail::deg / 3600.0;  ///< 1 sigma per axis at each caging [rad]
  ProcessNoise noise;
  Mounting mounting;

  /// What is believed of a parameter that the model would estimate: its own prior, or the library's
  /// where its own is a known constant.
  Prior believed(std::size_t param) const {
    const Prior& own = priors[param];
    return own.kind == Prior::Kind::fixed ? TermLibrary::specs[param].prior_si() : own;
  }

  DriftModel model() const { return {coupling, TermLibrary::terms_of(active), mounting}; }
};

/// Where the loop of coupling "compensated" gets its estimate of the misalignments.
enum class LoopEstimate {
  given,     ///< a priori, from the file: `E_loop`
  feedback,  ///< the running estimate of the filter that watches the test
};

/// What makes the data.
struct TruthSpec : ModelSpec {
  LoopEstimate loop = LoopEstimate::given;
  Theta theta_loop = Theta::Zero();  ///< the loop's misalignments eta, xi when given [rad]
  ServoOptions servo;                ///< used by coupling "servo" alone
};

/// Initial estimates of a filter that differ from the prior means: (parameter, SI value).
using Start = std::vector<std::pair<std::size_t, double>>;

/// One estimator. Parameters whose prior is `fixed` are known constants, not states.
struct FilterSpec : ModelSpec {
  std::string name;
  int drawn_starts = 1;       ///< starts drawn from the prior, unless explicit
  std::vector<Start> starts;  ///< explicit starts; empty: drawn
};

}  // namespace drift
