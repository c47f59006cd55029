#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/strapdown/held_out.hpp"
#include "analysis/strapdown/score.hpp"

namespace drift::strapdown {

inline constexpr double surely_better =
    2.0;  ///< [standard errors] a better model must be better by

/// What held-out data say of a model against the one it is compared with.
enum class Verdict {
  reference,  ///< the first; nothing to compare with
  accepted,
  rejected,
  skipped,  ///< not tried: too few dwells or rotations for its parameters
};
std::string_view name_of(Verdict verdict);

/// One model tried.
struct Trial {
  std::string name;
  std::string equation;           ///< "eq5", "eq6"; "any" where the two are the same
  std::string against;            ///< the model it is compared with; empty: none
  std::size_t parameters = 0;     ///< estimated beyond the accelerometers', or of these
  std::optional<Score> gravity;   ///< of |f| - g in dwells [m/s^2]
  std::optional<Score> dwell;     ///< of w_g - w_l in dwells [deg/s]
  std::optional<Score> rotation;  ///< of up after a turn [deg]
  double z_dwell = 0.0;           ///< paired gain on held-out dwells over its standard error
  double z_rotation = 0.0;        ///< likewise on rotations
  Verdict verdict = Verdict::reference;
  std::string reason;
};

/// The model an equation ends with.
struct Final {
  std::string name;
  Model model;
  Score rotation;  ///< [deg]
  Fitted fitted;   ///< to all data
};

/// How trials are scored.
struct Scoring {
  Division division;
  double gravity = 9.80665;  ///< [m/s^2]
};

/// Tries nominal, bias_scale, misaligned, quadratic; accepted is what is better on held-out dwells
/// than the last accepted model by two standard errors.
AccelerometerModel climb_accelerometers(const Evidence& evidence, const Scoring& scoring,
                                        std::vector<Trial>& trials);

/// Tries fixed drift; + scale factors; + scale factors and misalignment; + drift along the input
/// axes; + all drift of first order; + drift of second order; then what was accepted without each
/// of its parts.
///
/// Accepted is what is better than the last accepted model by two standard errors on held-out
/// dwells or rotations, and not worse by one standard error on the other kind. A part that is left
/// out without such a loss is not kept.
Final climb_gyros(Coupling equation, AccelerometerModel accelerometer, const Evidence& evidence,
                  const Scoring& scoring, std::vector<Trial>& trials);

}  // namespace drift::strapdown
