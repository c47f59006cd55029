#include "analysis/inference/noise/quasi_newton.hpp"

#include <cmath>

#include "mc/task/campaign.hpp"

namespace drift::inference {
namespace {

using Function = std::function<double(const VecX&)>;

VecX gradient(const Function& f, const VecX& x, double here) {
  constexpr double apart = 1e-3;
  const auto slopes = mc::run_campaign(static_cast<std::size_t>(x.size()), [&](std::size_t k) {
    VecX next = x;
    next[static_cast<Eigen::Index>(k)] += apart;
    return (f(next) - here) / apart;
  });
  return Eigen::Map<const VecX>(slopes.data(), x.size());
}

/// The inverse of minus the Hessian after a step on which the gradient fell by y.
MatX updated(const MatX& H, const VecX& step, const VecX& y) {
  const double sy = step.dot(y);
  if (!(sy > 1e-12)) return H;
  const MatX I = MatX::Identity(H.rows(), H.cols());
  return (I - step * y.transpose() / sy) * H * (I - y * step.transpose() / sy) +
         step * step.transpose() / sy;
}

}  // namespace

Maximum maximise(const Function& f, const VecX& x, const MatX& inverse_curvature) {
  constexpr int most_steps = 25, most_cuts = 8;
  constexpr double cut = 0.3, enough = 1e-3;  // gain of a step below which it stands still
  constexpr double well_known = 0.25;         // error of a curvature by which a step is whole
  Maximum at{x, f(x), inverse_curvature};
  VecX g = gradient(f, at.x, at.value);
  for (int k = 0; k < most_steps; ++k) {
    VecX step = at.inverse_curvature * g;
    const double promised = 0.5 * g.dot(step);
    // The first step goes by a guess of the curvature.
    if (k > 0 && promised < enough) break;
    const double longest = step.cwiseAbs().maxCoeff();
    if (longest > 1.0) step /= longest;
    double next = f(at.x + step);
    for (int cuts = 0; cuts < most_cuts && !(next > at.value); ++cuts) {
      step *= cut;
      next = f(at.x + step);
    }
    if (!(next > at.value)) break;
    const double gain = next - at.value;
    at.x += step;
    at.value = next;
    if (gain < enough) break;
    // By a curvature that is (1 + e) times the true one a whole step gains (1 + 2 e) / (1 + e) of
    // what it promised and leaves e^2 / (1 + e) of it.
    const double e = (gain - promised) / (2.0 * promised - gain);
    if (longest <= 1.0 && std::abs(e) < well_known && promised * well_known * well_known < enough) {
      at.inverse_curvature += e / (2.0 * promised) * step * step.transpose();
      break;
    }
    const VecX g_next = gradient(f, at.x, at.value);
    at.inverse_curvature = updated(at.inverse_curvature, step, g - g_next);
    g = g_next;
  }
  return at;
}

}  // namespace drift::inference
