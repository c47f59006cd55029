#include "mc/task/unmodelled.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/estimate/layout.hpp"
#include "core/physics/stochastic.hpp"

namespace drift::mc {
namespace {

bool is_state(const Layout& layout, std::size_t param) {
  return std::ranges::find(layout.params, param) != layout.params.end();
}

/// What makes the drift of gyro `axis` vary, as a study file has it.
std::vector<std::string> drift_noise(const FilterSpec& filter, const Layout& layout, int axis) {
  const TermMask terms = filter.model().terms;
  std::vector<std::string> found;
  if (filter.noise.drift_random_walk > 0.0) found.emplace_back("'drift_random_walk'");
  for (const DriftNoise& n : drift_noises)
    if (terms[n.term] && n.size(layout.theta, axis) != 0.0)
      found.push_back(fmt::format("term '{}'", TermLibrary::terms[n.term].key));
  return found;
}

using Messages = std::vector<std::string>;

/// A batch fit knows angle random walk, and would take a drift that varies for one that does not.
Messages noise_in_batch(const FilterSpec& filter, const Layout& layout) {
  std::vector<std::string> noise;
  for (int axis = 0; axis < 3; ++axis)
    for (std::string& what : drift_noise(filter, layout, axis))
      if (std::ranges::find(noise, what) == noise.end()) noise.push_back(std::move(what));
  if (noise.empty()) return {};
  return {fmt::format(
      "filter \"{}\" has process noise ({}), which estimator = \"batch\" does not model: it would "
      "be sure of wrong values (expected \"ekf\" or \"iterated\"). Set monte_carlo.estimator = "
      "\"iterated\", or remove the noise from the filter",
      filter.name, fmt::join(noise, ", "))};
}

/// A sequential estimator has the noise of a drift in D_F.
Messages noise_without_state(EstimatorKind estimator, const FilterSpec& filter,
                             const Layout& layout) {
  constexpr auto fixed_drift = TermLibrary::index("D_F_x");
  Messages messages;
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<std::string> noise = drift_noise(filter, layout, axis);
    if (noise.empty() || is_state(layout, fixed_drift + axis)) continue;
    const std::string_view key = TermLibrary::specs[fixed_drift + axis].key;
    messages.push_back(fmt::format(
        "filter \"{}\" lets a drift vary ({}) that it does not estimate, so estimator = \"{}\" has "
        "no state for it (expected {} with a prior). Add term \"fixed_drift\" to the filter, or "
        "remove the noise",
        filter.name, fmt::join(noise, ", "), key_of(estimator), key));
  }
  return messages;
}

/// Lambda times misalignment is a product of unknowns, a bent valley. One pass from afar, and a few
/// more about where it ended, can settle beside it.
Messages free_closure(EstimatorKind estimator, const FilterSpec& filter, const Layout& layout) {
  const bool misaligned = std::ranges::any_of(layout.params, [](std::size_t param) {
    const std::string_view term = TermLibrary::owner(param).key;
    return term == "gyro_misalignment" || term == "misalignment_creep";
  });
  if (!misaligned || !is_state(layout, closure_param)) return {};
  return {fmt::format(
      "filter \"{}\" estimates lambda (term 'frame_closure') and misalignments, a product of "
      "unknowns that estimator = \"{}\" linearises from afar: it can end sure of a wrong value "
      "(expected \"batch\"). Set monte_carlo.estimator = \"batch\", or give lambda a number in "
      "[filter.parameters]",
      filter.name, key_of(estimator))};
}

}  // namespace

Messages unmodelled(EstimatorKind estimator, const FilterSpec& filter) {
  const Layout layout = make_layout(filter);
  if (estimator == EstimatorKind::batch) return noise_in_batch(filter, layout);
  Messages messages = noise_without_state(estimator, filter, layout);
  for (std::string& m : free_closure(estimator, filter, layout)) messages.push_back(std::move(m));
  return messages;
}

}  // namespace drift::mc
