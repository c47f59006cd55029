#pragma once

#include "analysis/diagnosis/findings/diagnosis.hpp"
#include "analysis/strapdown/residuals.hpp"

namespace drift::strapdown {

/// Fills `where`, the residuals and in-sample chi-square of `fit`, and the recovered signals of a
/// diagnosis from residuals before and after, in units of `scatter`. Positions are dwells. theta:
/// of the accelerometers, for the attitude that the signals are compared with.
void fill_where(const Residuals& before, const Residuals& after,
                const Eigen::Vector<double, 5>& scatter, const Evidence& evidence,
                const Theta& theta, diagnosis::Diagnosis& diagnosis);

}  // namespace drift::strapdown
