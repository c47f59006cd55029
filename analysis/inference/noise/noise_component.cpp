#include "analysis/inference/noise/noise_component.hpp"

namespace drift::inference {

RowCounts::RowCounts(const MeasuredRows& rows) {
  for (const RowTag& t : rows.tags) ++(t.accelerometer() ? accelerometer : gimbal);
}

std::vector<Addition> possible_additions(const NoiseModel& model, const RowCounts& rows) {
  std::vector<Addition> all;
  for (const NoiseComponent* c : {&angle_walk, &drift_walk})
    if (!c->in(model)) all.push_back({c});
  if (!markov_drift.in(model))
    for (const double tau : {600.0, 2400.0}) all.push_back({&markov_drift, tau});
  // Gimbals tell it from what drives the platform.
  if (!acc_markov.in(model) && rows.accelerometer > 0 && rows.gimbal > 0)
    for (const double tau : {150.0, 900.0}) all.push_back({&acc_markov, tau});
  return all;
}

}  // namespace drift::inference
