#include "analysis/inference/noise/noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "analysis/inference/marginal.hpp"
#include "analysis/inference/noise/mixture.hpp"
#include "analysis/inference/noise/noise_component.hpp"
#include "analysis/inference/noise/sigma_ladder.hpp"
#include "analysis/inference/thresholds.hpp"
#include "core/stats/chi_square.hpp"
#include "mc/task/campaign.hpp"

namespace drift::inference {
namespace {

/// White noise and whatever is declared. What rounding makes of a reading that hardly moves looks
/// like less noise and like something that swings: it is held where it is known to be.
Mixture declared_mixture(const MarginalLikelihood& rows, const NoiseModel& declared) {
  const RowCounts count(rows.measured());
  Mixture m{declared, {}, 0.0, {}};
  if (count.accelerometer > 0 && !rows.measured().acc_rounded) m.active.push_back({&acc_white});
  if (count.gimbal > 0 && !rows.measured().gimbals_rounded) m.active.push_back({&gimbal_white});
  for (const NoiseComponent* c : beside_white)
    if (c->in(declared)) m.active.push_back({c});
  return fitted(rows, std::move(m));
}

NoiseModel with(const NoiseModel& model, const Addition& a, double sigma) {
  NoiseModel more = model;
  more.*(a.component->sigma) = sigma;
  if (a.component->tau) more.*(a.component->tau) = a.tau;
  return more;
}

/// With the component among those offered that gains most, all sigmas at their best; none if that
/// is not enough. The rungs of the ladder are far apart: each component is fitted from its best
/// one, and the one of best evidence is taken. (A Markov process of a time constant as short as a
/// sample is an angle random walk, and the prior of time constants says so.)
std::optional<Mixture> with_one_more(const MarginalLikelihood& rows, const Mixture& m,
                                     const NoiseModel& declared,
                                     const std::vector<Addition>& additions) {
  constexpr int rungs = 8;
  constexpr double drop = 3.0;
  const std::vector<Rung> tried = mc::run_campaign(additions.size(), [&](std::size_t k) {
    const NoiseComponent& c = *additions[k].component;
    const double lowest = usual_size(c, declared).low * unit_of(c, rows.measured().acc_sigma) / 3.0;
    return climb(lowest, rungs, drop, [&](double sigma) {
      return rows.log_likelihood2(with(m.model, additions[k], sigma)) - m.log_likelihood2;
    });
  });
  std::vector<std::size_t> order(tried.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t k) { return tried[k].gain; });
  std::optional<Mixture> best;
  std::vector<const NoiseComponent*> fitted_already;
  for (const std::size_t k : order) {
    const NoiseComponent* c = additions[k].component;
    // On the ladder's rungs: what is close to enough is worth the ascent.
    if (tried[k].gain < 0.5 * NoiseLimits::component) break;
    if (std::ranges::find(fitted_already, c) != fitted_already.end()) continue;
    fitted_already.push_back(c);
    Mixture more = m;
    more.model = with(m.model, additions[k], tried[k].sigma);
    more.active.push_back({c});
    more = fitted(rows, std::move(more));
    more.active.back().gain = more.log_likelihood2 - m.log_likelihood2;
    if (more.active.back().gain < NoiseLimits::component) continue;
    if (!best || log_evidence(more, declared, rows.measured().acc_sigma) >
                     log_evidence(*best, declared, rows.measured().acc_sigma))
      best = std::move(more);
  }
  return best;
}

/// Twice the log likelihood of a mixture over that of one of whose components is as declared.
double gain_over_declared(const MarginalLikelihood& rows, Mixture m, std::size_t k,
                          const NoiseModel& declared) {
  const double best = m.log_likelihood2;
  double NoiseModel::*const sigma = m.active[k].component->sigma;
  m.model.*sigma = declared.*sigma;
  m.active.erase(m.active.begin() + static_cast<std::ptrdiff_t>(k));
  m.covariance = {};
  return std::max(0.0, best - fitted(rows, std::move(m)).log_likelihood2);
}

/// A component that drives the platform: p by its gain, or against what was declared.
NoiseFinding driving_finding(const MarginalLikelihood& rows, const Mixture& m, std::size_t k,
                             const NoiseModel& declared) {
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
    const double log_sigma = std::sqrt(m.covariance(i, i));
    f.factor = sigma / was;
    f.factor_sigma = f.factor * log_sigma;
    const double z = std::log(f.factor) / log_sigma;
    f.p_value = std::exp(stats::log_tail(z * z, 1.0));
    // Of next to none its log is not known, however well it is known that it is none.
    if (f.factor < 1.0 && f.p_value >= NoiseLimits::significant_p)
      f.p_value = std::exp(stats::log_tail(gain_over_declared(rows, m, k, declared), 1.0));
    f.significant = f.p_value < NoiseLimits::significant_p;
  }
  return f;
}

std::vector<NoiseFinding> findings_of(const Mixture& m, const NoiseModel& declared,
                                      const MarginalLikelihood& likelihood) {
  const MeasuredRows& rows = likelihood.measured();
  const RowCounts count(rows);
  std::vector<NoiseFinding> all;
  for (std::size_t k = 0; k < m.active.size(); ++k) {
    const NoiseComponent& c = *m.active[k].component;
    all.push_back(c.white() ? white_finding(c.name, m.model.*(c.sigma) / (declared.*(c.sigma)),
                                            1.0 / std::sqrt(2.0 * static_cast<double>(count.of(c))),
                                            count.of(c))
                            : driving_finding(likelihood, m, k, declared));
    if (rows.driven_at_most && &c != &acc_white && all.back().factor < 1.0)
      all.back().significant = false;
  }
  return all;
}

NoiseEstimate as_estimate(const Mixture& m, const NoiseModel& declared,
                          const MarginalLikelihood& rows) {
  NoiseEstimate out;
  out.model = m.model;
  out.findings = findings_of(m, declared, rows);
  out.log_likelihood2 = m.log_likelihood2;
  out.log_price =
      NoisePrior::log_not_as_declared() + log_price(m, declared, rows.measured().acc_sigma);
  out.covariance = m.covariance;
  for (std::size_t k = 0; k < m.active.size(); ++k) {
    const NoiseComponent& c = *m.active[k].component;
    const NoiseFinding& f = out.findings[k];
    out.driven = out.driven || (!c.white() && (!c.in(declared) || f.factor > 1.0));
    out.components.push_back(&c);
  }
  return out;
}

/// The noise of `start` where it holds for these rows as well, less what the evidence is better
/// without. None where a component that drives the platform would be likelier at a third of its
/// sigma.
std::optional<Mixture> much_as(const MarginalLikelihood& rows, const NoiseModel& declared,
                               const NoiseEstimate& start) {
  if (start.components.empty()) return std::nullopt;
  Mixture m{start.model, {}, 0.0, start.covariance};
  const double there = rows.log_likelihood2(start.model);
  for (const NoiseComponent* c : start.components) {
    m.active.push_back({c});
    NoiseModel less = start.model;
    less.*(c->sigma) /= 3.0;
    if (!c->white() && rows.log_likelihood2(less) >= there) return std::nullopt;
  }
  m = fitted(rows, std::move(m));
  for (std::size_t k = 0; k < m.active.size();) {
    const NoiseComponent& c = *m.active[k].component;
    if (c.white() || c.in(declared)) {
      ++k;
      continue;
    }
    Mixture fewer = without(rows, m, k);
    if (log_evidence(fewer, declared, rows.measured().acc_sigma) >=
        log_evidence(m, declared, rows.measured().acc_sigma)) {
      m = std::move(fewer);
      k = 0;  // what the others gain is another now
    } else {
      m.active[k++].gain = m.log_likelihood2 - fewer.log_likelihood2;
    }
  }
  return m;
}

}  // namespace

NoiseEstimate estimate_noise(const LinearProblem& problem, const NoiseModel& declared,
                             const std::vector<int>& in_mean, int most_added, Cagings cagings) {
  const MarginalLikelihood rows(problem, in_mean);
  Mixture m = declared_mixture(rows, declared);
  for (int added = 0; added < most_added; ++added) {
    std::optional<Mixture> more = with_one_more(
        rows, m, declared, possible_additions(m.model, RowCounts(rows.measured()), cagings));
    if (!more) break;
    m = std::move(*more);
  }
  return as_estimate(m, declared, rows);
}

NoiseEstimate estimate_noise_from(const LinearProblem& problem, const NoiseModel& declared,
                                  const NoiseEstimate& start, const std::vector<int>& in_mean) {
  const MarginalLikelihood rows(problem, in_mean);
  if (const std::optional<Mixture> m = much_as(rows, declared, start))
    return as_estimate(*m, declared, rows);
  Mixture m = declared_mixture(rows, declared);
  while (true) {
    std::vector<Addition> offered;
    for (const NoiseComponent* c : beside_white)
      if (c->in(start.model) && !c->in(m.model))
        offered.push_back({c, c->tau ? start.model.*(c->tau) : 0.0});
    std::optional<Mixture> more = with_one_more(rows, m, declared, offered);
    if (!more || log_evidence(*more, declared, rows.measured().acc_sigma) <=
                     log_evidence(m, declared, rows.measured().acc_sigma))
      break;
    m = std::move(*more);
  }
  return as_estimate(m, declared, rows);
}

}  // namespace drift::inference
