#pragma once

#include "analysis/search/fitted.hpp"

namespace drift::search {

/// Standard deviation about `value` of a nonlinear parameter of simultaneous causes, from the
/// evidence of all settings of choices[which] with the others as they are (SI, as the settings
/// are). The curvature at the best setting knows nothing of another onset that explains the test as
/// well; this does.
double setting_spread(const Fitted& nominal, const std::vector<Choice>& choices, std::size_t which,
                      std::size_t param, double value);

/// How far apart the settings were tried about that of a choice, at least: no finer is it known
/// where no slope leads a fit to it.
double settings_apart(const Fitted& nominal, const Choice& choice, std::size_t param);

/// The values of a discrete parameter of choices[which] that hold `credible` of the probability by
/// the same evidence, in order (SI); the one that was fitted is among them.
std::vector<double> credible_settings(const Fitted& nominal, const std::vector<Choice>& choices,
                                      std::size_t which, std::size_t param, double credible);

}  // namespace drift::search
