#include <algorithm>
#include <functional>

#include "analysis/identification/beyond_prior.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/report/identify/judgement.hpp"

namespace drift::report {
namespace {

using identification::BeyondPrior;

std::vector<BeyondPrior> far_parameters(const FilterView& v) {
  const EstimateResult& result = judged(v);
  if (result.parameters.empty()) return {};
  return identification::beyond_prior(
      result, identification::farthest_by_chance(result.parameters.size(),
                                                 inference::FitLimits::far_from_prior));
}

/// Parameters that no prior of the study would have where the filter takes them.
std::string beyond_text(const FilterView& v) {
  const std::vector<std::string> keys = beyond_prior(v);
  if (keys.empty()) return "";
  const bool one = keys.size() == 1;
  return fmt::format("Filter {}: {} further than {:g} of {} prior sigmas from {} ({}): {}.",
                     v.spec().name,
                     one ? "1 parameter lies" : fmt::format("{} parameters lie", keys.size()),
                     inference::FitLimits::beyond_prior, one ? "its" : "their",
                     one ? "its prior's mean" : "the means of their priors",
                     listed_up_to(keys, most_far_named), behind_far_priors);
}

std::string far_text(const FilterView& v) {
  const std::vector<BeyondPrior> far = far_parameters(v);
  if (far.empty() || !believed(v)) return "";
  const double sigmas = std::ranges::max_element(far, {}, &BeyondPrior::sigmas)->sigmas;
  const std::size_t of = judged(v).parameters.size();
  return fmt::format(
      "Filter {}: far from the mean of {} prior: {} ({} prior sigmas; chance that one of {} is: "
      "{}). Missing physics, or another drift equation, may hide in what a filter estimates.",
      v.spec().name, far.size() == 1 ? "its" : "their",
      listed_up_to(keys_of_far(far), most_far_named),
      far.size() == 1 ? number_text(sigmas, 2) : "up to " + number_text(sigmas, 2), of,
      p_text(identification::chance_of_farthest(of, sigmas)));
}

}  // namespace

std::vector<std::string> keys_of_far(std::vector<BeyondPrior> far) {
  std::ranges::stable_sort(far, std::greater{}, &BeyondPrior::sigmas);
  std::vector<std::string> keys;
  for (const BeyondPrior& p : far) keys.push_back(parameter_key(p.param));
  return keys;
}

std::vector<std::string> beyond_prior(const FilterView& v) {
  return keys_of_far(identification::beyond_prior(judged(v)));
}

std::vector<std::string> far_from_prior(const FilterView& v) {
  return keys_of_far(far_parameters(v));
}

SaidOfPriors priors_text(const FilterView& v) {
  if (std::string text = beyond_text(v); !text.empty()) return {Weight::wrong, std::move(text)};
  return {Weight::doubtful, far_text(v)};
}

}  // namespace drift::report
