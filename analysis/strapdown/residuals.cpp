#include "analysis/strapdown/residuals.hpp"

#include <cmath>
#include <limits>

namespace drift::strapdown {

Residuals residuals_of(const Model& model, const Fitted& fitted, const Evidence& evidence) {
  const auto n = static_cast<Eigen::Index>(evidence.dwells.size());
  Residuals r = Residuals::Constant(5, n, std::numeric_limits<double>::quiet_NaN());
  const SpecificForce force(fitted.accelerometer.theta);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Dwell& dwell = evidence.dwells[static_cast<std::size_t>(k)];
    const Vec3 f = force(dwell.acc);
    r.col(k).head<3>() = dwell.gyro - drift_rate(fitted.drift.theta, f);
    r(4, k) = f.norm() - 1.0;
  }
  for (const Rotation& turn : evidence.rotations)
    r(3, static_cast<Eigen::Index>(turn.before)) = prediction_error(
        calibrated(turn, evidence.dwells, force), model.equation, fitted.turning.theta);
  return r;
}

Eigen::Vector<double, 5> scatter_of(const Residuals& residuals) {
  const auto rms = [&](int first, int count) {
    double sum = 0.0, n = 0.0;
    for (const double v : residuals.middleRows(first, count).reshaped())
      if (std::isfinite(v)) {
        sum += v * v;
        n += 1.0;
      }
    return std::max(std::sqrt(sum / n), 1e-12);
  };
  const double gyro = rms(0, 3);
  return Eigen::Vector<double, 5>{gyro, gyro, gyro, rms(3, 1), rms(4, 1)};
}

std::vector<DwellScore> scores_of(const Errors& held_out, const Evidence& evidence,
                                  const Eigen::Vector<double, 5>& scatter) {
  std::vector<DwellScore> scores(evidence.dwells.size());
  const auto add = [](DwellScore& score, double error, double sigma, std::size_t dof) {
    score.chi2 += static_cast<double>(dof) * error * error / (sigma * sigma);
    score.dof += dof;
  };
  for (std::size_t k = 0; k < scores.size(); ++k) {
    add(scores[k], held_out.dwell[k], scatter[0], 3);  // errors.dwell is the mean over three gyros
    add(scores[k], held_out.gravity[k], scatter[4], 1);
  }
  for (std::size_t k = 0; k < evidence.rotations.size(); ++k)
    add(scores[evidence.rotations[k].before], held_out.rotation[k], scatter[3], 1);
  return scores;
}

}  // namespace drift::strapdown
