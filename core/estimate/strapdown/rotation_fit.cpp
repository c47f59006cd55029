#include "core/estimate/strapdown/rotation_fit.hpp"

#include <cmath>
#include <limits>

#include "core/base/decompose.hpp"
#include "core/estimate/strapdown/least_squares.hpp"

namespace drift::strapdown {
namespace {

bool takes_part(std::size_t param, Coupling equation) {
  const auto name = TermLibrary::specs[param].group.view();
  return equation != Coupling::eq6 || (name != "eta" && name != "xi");
}

MatX jacobian_of(std::span<const Rotation> rotations, Coupling equation, const Theta& theta,
                 std::span<const std::size_t> params) {
  MatX all(static_cast<Eigen::Index>(3 * rotations.size()),
           static_cast<Eigen::Index>(params.size()));
  for (std::size_t k = 0; k < rotations.size(); ++k)
    all.middleRows<3>(static_cast<Eigen::Index>(3 * k)) =
        predict(rotations[k], equation, theta, params).jacobian;
  return all;
}

}  // namespace

Estimate fit_rotations(std::span<const Rotation> rotations, Coupling equation,
                       const Estimate& drift, std::span<const std::size_t> params) {
  std::vector<std::size_t> free;
  for (const std::size_t p : params)
    if (takes_part(p, equation)) free.push_back(p);
  const auto n = static_cast<Eigen::Index>(rotations.size());
  // The drift does not change while the rest is sought: it is taken out once.
  std::vector<Rotation> turns;
  for (const Rotation& turn : rotations) turns.push_back(without_drift(turn, drift.theta));
  const auto with = [&](const VecX& x) {
    Theta theta = drift.theta;
    for (std::size_t i = 0; i < free.size(); ++i) theta[free[i]] = x[static_cast<Eigen::Index>(i)];
    return theta;
  };
  const Residuals residuals = [&](const VecX& x, MatX* jacobian) {
    const Theta theta = with(x) - drift.theta;
    VecX r(3 * n);
    if (jacobian != nullptr) jacobian->resize(3 * n, x.size());
    for (Eigen::Index k = 0; k < n; ++k) {
      const Rotation& turn = turns[static_cast<std::size_t>(k)];
      const Prediction predicted = predict(turn, equation, theta, free);
      r.segment<3>(3 * k) = predicted.up - turn.up_after;
      if (jacobian != nullptr && x.size() > 0) jacobian->middleRows<3>(3 * k) = predicted.jacobian;
    }
    return r;
  };
  const auto p = static_cast<Eigen::Index>(free.size());
  const Minimum best = minimise(residuals, VecX::Zero(p));
  Estimate fit;
  fit.params.assign(params.begin(), params.end());
  fit.theta = with(best.x);
  fit.converged = best.converged;
  fit.rms =
      std::sqrt(best.residuals.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(n, 1)));
  MatX covariance =
      best.covariance(static_cast<double>(2 * n - p));  // a direction has two freedoms
  if (p > 0 && !drift.params.empty()) {
    const MatX by_drift = jacobian_of(rotations, equation, fit.theta, drift.params);
    const MatX gain = solve_symmetric(best.jacobian.transpose() * best.jacobian,
                                      MatX(best.jacobian.transpose() * by_drift));
    covariance += gain * drift.covariance * gain.transpose();
  }
  constexpr double unknown = std::numeric_limits<double>::infinity();
  const auto all = static_cast<Eigen::Index>(params.size());
  fit.covariance = MatX::Zero(all, all);
  for (Eigen::Index i = 0, fi = 0; i < all; ++i) {
    if (!takes_part(params[static_cast<std::size_t>(i)], equation)) {
      fit.covariance(i, i) = unknown;
      continue;
    }
    for (Eigen::Index j = 0, fj = 0; j < all; ++j)
      if (takes_part(params[static_cast<std::size_t>(j)], equation))
        fit.covariance(i, j) = covariance(fi, fj++);
    ++fi;
  }
  return fit;
}

}  // namespace drift::strapdown
