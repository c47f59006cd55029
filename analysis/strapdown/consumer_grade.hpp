#pragma once

#include "core/physics/model_spec.hpp"

namespace drift::strapdown {

/// What is believed beforehand of a parameter of a unit whose gyros do not see the Earth, as data
/// sheets of micromechanical sensors state it [SI, 1 sigma]: drift 20 deg/s, 0.1 deg/s/g and a
/// tenth of that per g^2; scale factors 3 %; axes 2 %; accelerometer offset 100 mg, nonlinearity
/// 0.5 %. Amplitudes that no data sheet has: a hundred times the library's, which are those of an
/// inertial-grade unit.
Prior consumer_prior(std::size_t param);

/// A filter in which priors of the library are those of such a unit; what the study states stays.
void take_consumer_priors(FilterSpec& filter);

}  // namespace drift::strapdown
