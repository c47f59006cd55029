#include "analysis/inference/noise_component.hpp"

#include "core/base/units.hpp"

namespace drift::inference {
namespace {

constexpr double deg_per_h = detail::deg / 3600.0;         // [rad/s]
constexpr double deg_per_root_h = detail::deg / 60.0;      // [rad/sqrt(s)]
constexpr double deg_per_h_per_root_h = deg_per_h / 60.0;  // [rad/s/sqrt(s)]

}  // namespace

const NoiseComponent acc_white{
    "accelerometer_white", &NoiseModel::acc_factor, nullptr, 1.0, "1", 1.0};
const NoiseComponent gimbal_white{
    "gimbal_white", &NoiseModel::gimbal_factor, nullptr, 1.0, "1", 1.0};
const NoiseComponent angle_walk{"angle_random_walk",
                                &NoiseModel::angle_random_walk,
                                nullptr,
                                1e-3 * deg_per_root_h,
                                "deg/sqrt(h)",
                                deg_per_root_h};
const NoiseComponent drift_walk{"drift_random_walk",
                                &NoiseModel::drift_random_walk,
                                nullptr,
                                3e-3 * deg_per_h_per_root_h,
                                "deg/h/sqrt(h)",
                                deg_per_h_per_root_h};
const NoiseComponent markov_drift{
    "markov_drift", &NoiseModel::markov_drift, &NoiseModel::markov_tau, 3e-3 * deg_per_h, "deg/h",
    deg_per_h};
const NoiseComponent acc_markov{
    "accelerometer_markov", &NoiseModel::acc_markov, &NoiseModel::acc_tau, 2e-6, "ug", 1e-6};

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
