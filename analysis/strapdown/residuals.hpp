#pragma once

#include <string>
#include <vector>

#include "analysis/strapdown/held_out.hpp"

namespace drift::strapdown {

/// Residuals of a fitted model dwell by dwell, in sample. Shape (5, dwells): gyro x y z [rad/s],
/// angle of up after the turn that starts from the dwell [rad], |f| - 1 [g]. NaN where there is no
/// turn.
using Residuals = Eigen::Matrix<double, 5, Eigen::Dynamic>;
inline const std::vector<std::string> residual_names{"gyro_x", "gyro_y", "gyro_z", "turn", "acc"};

Residuals residuals_of(const Model& model, const Fitted& fitted, const Evidence& evidence);

/// Root mean square of each kind (gyros together), for scaling. Shape 5.
Eigen::Vector<double, 5> scatter_of(const Residuals& residuals);

/// Chi-square of held-out errors of one dwell and its turn, in units of a scatter, and its degrees.
struct DwellScore {
  double chi2 = 0.0;
  std::size_t dof = 0;
};
std::vector<DwellScore> scores_of(const Errors& held_out, const Evidence& evidence,
                                  const Eigen::Vector<double, 5>& scatter);

}  // namespace drift::strapdown
