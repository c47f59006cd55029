#include "analysis/inference/noise/noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "analysis/inference/noise/noise_component.hpp"
#include "analysis/inference/noise/quasi_newton.hpp"
#include "analysis/inference/noise/sigma_ladder.hpp"
#include "analysis/inference/projector.hpp"
#include "analysis/inference/thresholds.hpp"
#include "core/stats/chi_square.hpp"
#include "mc/task/campaign.hpp"

namespace drift::inference {
namespace {

/// A component whose sigma is estimated.
struct Active {
  const NoiseComponent* component = nullptr;
  double gain = 0.0;  ///< of twice the log likelihood when it was added; 0: there from the start
};

/// A noise model at the best of its active components.
struct Mixture {
  NoiseModel model;
  std::vector<Active> active;
  double log_likelihood2 = 0.0;
  MatX log_sigma_covariance;  ///< of the active components
};

double log_likelihood2(const LinearProblem& bare, const NoiseModel& m) {
  const double v = marginal_of(bare, m).log_likelihood2();
  return std::isfinite(v) ? v : -std::numeric_limits<double>::infinity();
}

NoiseModel at(const Mixture& m, const VecX& log_sigma) {
  NoiseModel model = m.model;
  for (std::size_t k = 0; k < m.active.size(); ++k)
    model.*(m.active[k].component->sigma) = std::exp(log_sigma[static_cast<Eigen::Index>(k)]);
  return model;
}

/// The best sigmas of the active components, from where they are.
Mixture fitted(const LinearProblem& bare, Mixture m) {
  const RowCounts rows(bare);
  const auto n = static_cast<Eigen::Index>(m.active.size());
  VecX log_sigma(n), curvature(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const NoiseComponent& c = *m.active[static_cast<std::size_t>(k)].component;
    log_sigma[k] = std::log(m.model.*(c.sigma));
    curvature[k] = c.white() ? 2.0 * static_cast<double>(rows.of(c)) : 30.0;
  }
  const Maximum top = maximise([&](const VecX& x) { return 0.5 * log_likelihood2(bare, at(m, x)); },
                               log_sigma, curvature);
  m.model = at(m, top.x);
  m.log_likelihood2 = 2.0 * top.value;
  m.log_sigma_covariance = top.inverse_curvature;
  return m;
}

/// White noise and whatever is declared.
Mixture declared_mixture(const LinearProblem& bare, const NoiseModel& declared) {
  const RowCounts rows(bare);
  Mixture m{declared, {}, 0.0, {}};
  for (const NoiseComponent* white : {&acc_white, &gimbal_white})
    if (rows.of(*white) > 0) m.active.push_back({white});
  for (const NoiseComponent* c : {&angle_walk, &drift_walk})
    if (c->in(declared)) m.active.push_back({c});
  return fitted(bare, std::move(m));
}

NoiseModel with(const NoiseModel& model, const Addition& a, double sigma) {
  NoiseModel more = model;
  more.*(a.component->sigma) = sigma;
  if (a.component->tau) more.*(a.component->tau) = a.tau;
  return more;
}

/// With the component that gains most, all sigmas at their best; none if that is not enough.
std::optional<Mixture> with_one_more(const LinearProblem& bare, const Mixture& m) {
  constexpr int rungs = 8;
  constexpr double drop = 3.0;
  const std::vector<Addition> additions = possible_additions(m.model, RowCounts(bare));
  const std::vector<Rung> tried = mc::run_campaign(additions.size(), [&](std::size_t k) {
    return climb(additions[k].component->reference / 9.0, rungs, drop, [&](double sigma) {
      return log_likelihood2(bare, with(m.model, additions[k], sigma)) - m.log_likelihood2;
    });
  });
  const auto top = std::ranges::max_element(tried, {}, &Rung::gain);
  // On the ladder's rungs: what is close to enough is worth the ascent.
  if (top == tried.end() || top->gain < 0.5 * NoiseLimits::component) return std::nullopt;
  const Addition& addition = additions[static_cast<std::size_t>(top - tried.begin())];
  Mixture more = m;
  more.model = with(m.model, addition, top->sigma);
  more.active.push_back({addition.component});
  more = fitted(bare, std::move(more));
  more.active.back().gain = more.log_likelihood2 - m.log_likelihood2;
  if (more.active.back().gain < NoiseLimits::component) return std::nullopt;
  return more;
}

/// A component that drives the platform: p by its gain, or against what was declared.
NoiseFinding driving_finding(const Mixture& m, std::size_t k, const NoiseModel& declared) {
  const auto& [c, gain] = m.active[k];
  const double sigma = m.model.*(c->sigma), was = declared.*(c->sigma);
  NoiseFinding f;
  f.component = c->name;
  f.value = sigma / c->unit.to_si;
  f.unit = c->unit.symbol.view();
  if (c->tau) f.tau_s = m.model.*(c->tau);
  f.factor = f.factor_sigma = std::nan("");
  if (gain > 0.0) {
    f.log_likelihood_gain = 0.5 * gain;
    f.p_value =
        std::min(1.0, NoiseLimits::alternatives * 0.5 * std::exp(stats::log_tail(gain, 1.0)));
    f.significant = f.p_value < NoiseLimits::significant_p;
  }
  if (was > 0.0) {
    const auto i = static_cast<Eigen::Index>(k);
    const double log_sigma = std::sqrt(m.log_sigma_covariance(i, i));
    f.factor = sigma / was;
    f.factor_sigma = f.factor * log_sigma;
    const double z = std::log(f.factor) / log_sigma;
    f.p_value = std::exp(stats::log_tail(z * z, 1.0));
    f.significant = f.p_value < NoiseLimits::significant_p;
  }
  return f;
}

std::vector<NoiseFinding> findings_of(const Mixture& m, const NoiseModel& declared,
                                      const RowCounts& rows) {
  std::vector<NoiseFinding> all;
  for (std::size_t k = 0; k < m.active.size(); ++k) {
    const NoiseComponent& c = *m.active[k].component;
    all.push_back(c.white() ? white_finding(c.name, m.model.*(c.sigma) / (declared.*(c.sigma)),
                                            1.0 / std::sqrt(2.0 * static_cast<double>(rows.of(c))),
                                            rows.of(c))
                            : driving_finding(m, k, declared));
  }
  return all;
}

}  // namespace

NoiseEstimate estimate_noise(const LinearProblem& problem, const NoiseModel& declared,
                             const std::vector<int>& in_mean, int most_added) {
  const LinearProblem bare = problem.with_mean(in_mean).bare();
  Mixture m = declared_mixture(bare, declared);
  bool driven = false;
  for (int added = 0; added < most_added; ++added) {
    std::optional<Mixture> more = with_one_more(bare, m);
    if (!more) break;
    m = std::move(*more);
    driven = true;
  }
  return {m.model, findings_of(m, declared, RowCounts(bare)), m.log_likelihood2, driven};
}

}  // namespace drift::inference
