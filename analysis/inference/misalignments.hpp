#pragma once

#include "analysis/inference/projector.hpp"
#include "core/estimate/layout.hpp"

namespace drift::inference {

/// Whether a parameter is a misalignment of a gyro, which lambda multiplies.
bool is_misalignment(std::size_t param);

/// What it changes in the log evidence of a model that the size of the misalignments, all alike, is
/// known to orders of magnitude only (size_prior.hpp): no more is known of it than of any effect,
/// and less, as a unit that gives calibrated readings has none that a test would see.
/// One equation shows misalignments that another one hides. Were they as large as their prior for
/// certain, small ones would be a coincidence that speaks against the equation which shows them,
/// and a well aligned platform would be taken for one that follows the other. Of a free lambda, at
/// its value: what a test shows is a product with it, and misalignments of any size beside any
/// lambda are not what a linear problem has where these end. layout: of the parameters of the
/// linearised test.
double log_gain_of_misalignments(const Layout& layout, const Projector& projector);
/// The same of a fit: x and covariance in units of the priors, from their means; layout order.
double log_gain_of_misalignments(const Layout& layout, const VecX& x, const MatX& covariance);

}  // namespace drift::inference
