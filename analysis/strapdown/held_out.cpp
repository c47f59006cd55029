#include "analysis/strapdown/held_out.hpp"

#include <cmath>
#include <utility>

#include "core/base/rng.hpp"
#include "mc/task/campaign.hpp"

namespace drift::strapdown {
namespace {

using Part = std::vector<int>;  // of each dwell

Part divide(std::size_t dwells, const Division& division, int repeat) {
  Part part(dwells);
  for (std::size_t k = 0; k < dwells; ++k)
    part[k] = static_cast<int>(k % static_cast<std::size_t>(division.folds));
  Stream stream(division.seed, static_cast<std::uint64_t>(repeat), Purpose::design);
  for (std::size_t k = dwells; k > 1; --k) {
    const auto other = static_cast<std::size_t>(stream.uniform() * static_cast<double>(k));
    std::swap(part[k - 1], part[other]);
  }
  return part;
}

Fitted fit_to(const Model& model, const Evidence& evidence, Asked asked, auto&& trained) {
  Fitted fitted;
  std::vector<Vec3> outputs;
  for (std::size_t k = 0; k < evidence.dwells.size(); ++k)
    if (trained(k)) outputs.push_back(evidence.dwells[k].acc);
  fitted.accelerometer = fit_accelerometers(model.accelerometer, outputs);
  if (asked == Asked::gravity) return fitted;
  const SpecificForce force(fitted.accelerometer.theta);
  std::vector<Rest> rests;
  for (std::size_t k = 0; k < evidence.dwells.size(); ++k)
    if (trained(k)) rests.push_back({evidence.dwells[k].gyro, force(evidence.dwells[k].acc)});
  fitted.drift = fit_drift(model.drift, rests);
  std::vector<Rotation> turns;
  for (const Rotation& turn : evidence.rotations)
    if (trained(turn.before)) turns.push_back(calibrated(turn, evidence.dwells, force));
  fitted.turning = fit_rotations(turns, model.equation, fitted.drift, model.turning);
  return fitted;
}

/// Errors squared, where `tested` holds; zero elsewhere.
Errors squares(const Model& model, const Evidence& evidence, const Fitted& fitted, Asked asked,
               auto&& tested) {
  Errors errors{std::vector<double>(evidence.dwells.size()), {}, {}};
  const SpecificForce force(fitted.accelerometer.theta);
  for (std::size_t k = 0; k < evidence.dwells.size(); ++k)
    if (tested(k)) errors.gravity[k] = std::pow(force(evidence.dwells[k].acc).norm() - 1.0, 2);
  if (asked == Asked::gravity) return errors;
  errors.dwell.resize(evidence.dwells.size());
  errors.rotation.resize(evidence.rotations.size());
  for (std::size_t k = 0; k < evidence.dwells.size(); ++k) {
    const Dwell& dwell = evidence.dwells[k];
    if (tested(k))
      errors.dwell[k] =
          (dwell.gyro - drift_rate(fitted.drift.theta, force(dwell.acc))).squaredNorm() / 3.0;
  }
  for (std::size_t k = 0; k < evidence.rotations.size(); ++k) {
    const Rotation& turn = evidence.rotations[k];
    if (tested(turn.before))
      errors.rotation[k] = std::pow(prediction_error(calibrated(turn, evidence.dwells, force),
                                                     model.equation, fitted.turning.theta),
                                    2);
  }
  return errors;
}

void add(std::vector<double>& sum, const std::vector<double>& more) {
  sum.resize(more.size());
  for (std::size_t k = 0; k < more.size(); ++k) sum[k] += more[k];
}

Errors rooted(Errors sum, double count) {
  for (auto* list : {&sum.gravity, &sum.dwell, &sum.rotation})
    for (double& e : *list) e = std::sqrt(e / count);
  return sum;
}

constexpr auto every = [](std::size_t) { return true; };

}  // namespace

Fitted fit(const Model& model, const Evidence& evidence, Asked asked) {
  return fit_to(model, evidence, asked, every);
}

Errors in_sample_errors(const Model& model, const Evidence& evidence, Asked asked) {
  return rooted(squares(model, evidence, fit(model, evidence, asked), asked, every), 1.0);
}

Errors held_out_errors(const Model& model, const Evidence& evidence, Asked asked,
                       const Division& division) {
  const auto folds = static_cast<std::size_t>(division.folds);
  const auto tasks = folds * static_cast<std::size_t>(division.repeats);
  const auto parts = mc::run_campaign(tasks, [&](std::size_t task) {
    const Part part = divide(evidence.dwells.size(), division, static_cast<int>(task / folds));
    const int held = static_cast<int>(task % folds);
    const Fitted fitted =
        fit_to(model, evidence, asked, [&](std::size_t k) { return part[k] != held; });
    return squares(model, evidence, fitted, asked, [&](std::size_t k) { return part[k] == held; });
  });
  Errors sum;
  for (const Errors& part : parts) {
    add(sum.gravity, part.gravity);
    add(sum.dwell, part.dwell);
    add(sum.rotation, part.rotation);
  }
  return rooted(std::move(sum), division.repeats);
}

}  // namespace drift::strapdown
