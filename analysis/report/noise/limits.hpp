#pragma once

#include "core/stats/allan_fit.hpp"

namespace drift::report {

/// The upper limit (95 %) of a noise that was not found. At no averaging time can it have been more
/// than all noises together were (the interval of the measured deviation): where rests are short,
/// or the slopes describe the noise badly, the fit knows less of it than that. Zero where the noise
/// was not looked for.
double limit_of(const stats::AllanFit& fit, stats::AllanNoise noise);

}  // namespace drift::report
