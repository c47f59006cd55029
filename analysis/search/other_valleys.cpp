#include "analysis/search/other_valleys.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/inference/thresholds.hpp"

namespace drift::search {
namespace {

using inference::EffortLimits;
using inference::ReachLimits;

/// What a fit has of the setting at `place` of one of its choices; null if it is fixed.
const ParameterEstimate* estimate_at(const Fitted& nominal, const Refit& r, const Choice& choice,
                                     std::size_t place) {
  const auto& settings = nominal.set.candidates[choice.candidate].variants[choice.variant].settings;
  return r.after.fit.estimate.find(settings[place].first);
}

/// Uphill from a variant, as far as it goes.
std::size_t top_from(const std::vector<double>& evidence, std::size_t v) {
  while (true) {
    std::size_t next = v;
    if (v > 0 && evidence[v - 1] > evidence[next]) next = v - 1;
    if (v + 1 < evidence.size() && evidence[v + 1] > evidence[next]) next = v + 1;
    if (next == v) return v;
    v = next;
  }
}

}  // namespace

std::vector<SettingFound> settings_found(const Fitted& nominal, const Refit& r) {
  std::vector<SettingFound> found;
  for (const Choice& choice : r.choices)
    if (const auto place = continuous_setting(nominal.set.candidates[choice.candidate]))
      if (const ParameterEstimate* p = estimate_at(nominal, r, choice, *place))
        found.push_back({choice.candidate, p->value});
  return found;
}

bool same_valley(const Fitted& nominal, const Refit& a, const Refit& b) {
  constexpr double apart = 0.1;  // sigmas
  if (!same_causes(a.choices, b.choices)) return false;
  return std::ranges::all_of(a.choices, [&](const Choice& choice) {
    const auto place = continuous_setting(nominal.set.candidates[choice.candidate]);
    const ParameterEstimate* p = place ? estimate_at(nominal, a, choice, *place) : nullptr;
    const ParameterEstimate* q = place ? estimate_at(nominal, b, choice, *place) : nullptr;
    return !p || !q || std::abs(p->value - q->value) <= apart * p->sigma;
  });
}

std::vector<Explanation> other_valleys(const Fitted& nominal, const Refit& r) {
  std::vector<Explanation> others;
  for (std::size_t which = 0; which < r.choices.size(); ++which) {
    const inference::Candidate& c = nominal.set.candidates[r.choices[which].candidate];
    const auto place = continuous_setting(c);
    const ParameterEstimate* p =
        place ? estimate_at(nominal, r, r.choices[which], *place) : nullptr;
    if (!p) continue;
    const std::vector<double> evidence = evidence_of_settings(nominal, r.choices, which);
    const auto nearest = std::ranges::min_element(c.variants, {}, [&](const inference::Variant& v) {
      return std::abs(v.settings[*place].second - p->value);
    });
    const std::size_t own =
        top_from(evidence, static_cast<std::size_t>(nearest - c.variants.begin()));
    std::vector<std::size_t> tops =
        best_of(evidence, ReachLimits::refine_setting, EffortLimits::settings + 1);
    std::erase(tops, own);
    if (tops.size() > EffortLimits::settings) tops.resize(EffortLimits::settings);
    for (const std::size_t v : tops) {
      others.push_back(r.choices);
      others.back()[which].variant = v;
    }
  }
  return others;
}

}  // namespace drift::search
