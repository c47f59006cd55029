#include "analysis/inference/noise/mixture.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/inference/noise/quasi_newton.hpp"
#include "analysis/inference/thresholds.hpp"
#include "core/base/decompose.hpp"

namespace drift::inference {
namespace {

NoiseModel at(const Mixture& m, const VecX& logs) {
  NoiseModel model = m.model;
  Eigen::Index next = 0;
  for (const Active& a : m.active) model.*(a.component->sigma) = std::exp(logs[next++]);
  for (const std::size_t k : m.timed())
    model.*(m.active[k].component->tau) = std::exp(logs[next++]);
  return model;
}

/// Log prior of the time constants: log-normal, less its constant.
double log_prior_of_times(const Mixture& m, const NoiseModel& model) {
  double sum = 0.0;
  for (const std::size_t k : m.timed()) {
    const NoiseComponent& c = *m.active[k].component;
    sum -= 0.5 * std::pow(c.time.z(model.*(c.tau)), 2);
  }
  return sum;
}

/// A covariance of what is kept, the rest held where it is.
MatX covariance_beside(const MatX& all, const std::vector<Eigen::Index>& held) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < all.rows(); ++i)
    if (std::ranges::find(held, i) == held.end()) kept.push_back(i);
  return all(kept, kept) -
         all(kept, held) * Cholesky(MatX(all(held, held))).solve(MatX(all(held, kept)));
}

}  // namespace

Mixture fitted(const MarginalLikelihood& rows, Mixture m) {
  const RowCounts count(rows.measured());
  const std::vector<std::size_t> timed = m.timed();
  const auto sigmas = static_cast<Eigen::Index>(m.active.size());
  const Eigen::Index n = sigmas + static_cast<Eigen::Index>(timed.size());
  if (n == 0) {
    m.log_likelihood2 = rows.log_likelihood2(m.model);
    m.covariance = MatX(0, 0);
    return m;
  }
  VecX logs(n), guess = VecX::Constant(n, 1.0 / 30.0);
  for (Eigen::Index k = 0; k < sigmas; ++k) {
    const NoiseComponent& c = *m.active[static_cast<std::size_t>(k)].component;
    logs[k] = std::log(m.model.*(c.sigma));
    if (c.white()) guess[k] = 0.5 / static_cast<double>(count.of(c));
  }
  for (std::size_t k = 0; k < timed.size(); ++k)
    logs[sigmas + static_cast<Eigen::Index>(k)] =
        std::log(m.model.*(m.active[timed[k]].component->tau));
  const Maximum top = maximise(
      [&](const VecX& x) {
        const NoiseModel model = at(m, x);
        return 0.5 * rows.log_likelihood2(model) + log_prior_of_times(m, model);
      },
      logs, m.covariance.rows() == n ? m.covariance : MatX(guess.asDiagonal()));
  m.model = at(m, top.x);
  m.log_likelihood2 = 2.0 * (top.value - log_prior_of_times(m, m.model));
  m.covariance = top.inverse_curvature;
  return m;
}

double log_price(const Mixture& m, const NoiseModel& declared, double acc_sigma) {
  constexpr double half_log_2pi = 0.9189385332046727;
  if (m.active.empty()) return 0.0;
  const auto n = static_cast<double>(m.covariance.rows());
  double sum = n * half_log_2pi + Cholesky(m.covariance).L().diagonal().array().log().sum() +
               log_prior_of_times(m, m.model);
  for (const Active& a : m.active) {
    const NoiseComponent& c = *a.component;
    const Usual usual = usual_size(c, declared);
    sum += NoisePrior::log_density(usual.z(m.model.*(c.sigma) / unit_of(c, acc_sigma))) -
           std::log(usual.spread());
    if (c.tau) sum -= half_log_2pi + std::log(c.time.spread());
  }
  return sum;
}

double log_evidence(const Mixture& m, const NoiseModel& declared, double acc_sigma) {
  return 0.5 * m.log_likelihood2 + log_price(m, declared, acc_sigma);
}

Mixture without(const MarginalLikelihood& rows, Mixture m, std::size_t k) {
  std::vector<Eigen::Index> gone{static_cast<Eigen::Index>(k)};
  const std::vector<std::size_t> timed = m.timed();
  if (const auto at = std::ranges::find(timed, k); at != timed.end())
    gone.push_back(static_cast<Eigen::Index>(m.active.size()) + (at - timed.begin()));
  m.covariance = covariance_beside(m.covariance, gone);
  m.model.*(m.active[k].component->sigma) = 0.0;
  m.active.erase(m.active.begin() + static_cast<std::ptrdiff_t>(k));
  return fitted(rows, std::move(m));
}

}  // namespace drift::inference
