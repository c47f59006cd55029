#include "analysis/inference/noise/noise_component.hpp"

#include "analysis/inference/thresholds.hpp"

namespace drift::inference {

RowCounts::RowCounts(const MeasuredRows& rows) {
  for (const RowTag& t : rows.tags) ++(t.accelerometer() ? accelerometer : gimbal);
  for (const IntervalDrive& d : rows.drives) cagings += !d.rest && d.cage && !d.begins;
}

Usual usual_size(const NoiseComponent& c, const NoiseModel& declared) {
  const double was = declared.*(c.sigma), N = declared.angle_random_walk;
  if (was > 0.0) return {0.5 * was, 2.0 * was};
  if (N > angle_walk.size.high) {
    constexpr double per_sqrt_s = 1.0 / 60.0, least = NoisePrior::least_instability * per_sqrt_s,
                     most = NoisePrior::most_instability * per_sqrt_s;
    if (&c == &markov_drift || &c == &caging_drift) return {least * N, most * N};
    if (&c == &drift_walk) return {least * least * N, most * most * N};
  }
  return c.size;
}

std::vector<Addition> possible_additions(const NoiseModel& model, const RowCounts& rows,
                                         Cagings cagings) {
  std::vector<Addition> all;
  for (const NoiseComponent* c : {&angle_walk, &drift_walk})
    if (!c->in(model)) all.push_back({c});
  if (!markov_drift.in(model))
    for (const double tau : {600.0, 2400.0}) all.push_back({&markov_drift, tau});
  if (cagings == Cagings::may_differ && !caging_drift.in(model) && rows.cagings >= least_cagings)
    all.push_back({&caging_drift});
  // Gimbals tell it from what drives the platform.
  if (!acc_markov.in(model) && rows.accelerometer > 0 && rows.gimbal > 0)
    for (const double tau : {150.0, 900.0}) all.push_back({&acc_markov, tau});
  return all;
}

}  // namespace drift::inference
