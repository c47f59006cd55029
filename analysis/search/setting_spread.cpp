#include "analysis/search/setting_spread.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>

#include "analysis/search/scores/log_sum.hpp"

namespace drift::search {
namespace {

double value_of(const inference::Variant& v, std::size_t param) {
  return std::ranges::find(v.settings, param, &std::pair<std::size_t, double>::first)->second;
}

}  // namespace

double setting_spread(const Fitted& nominal, const std::vector<Choice>& choices, std::size_t which,
                      std::size_t param, double value) {
  const auto& variants = nominal.set.candidates[choices[which].candidate].variants;
  const std::vector<double> evidence = evidence_of_settings(nominal, choices, which);
  const double top = evidence.empty() ? never : std::ranges::max(evidence);
  if (top == never) return 0.0;
  double sum = 0.0, square = 0.0;
  for (std::size_t v = 0; v < evidence.size(); ++v) {
    const auto setting =
        std::ranges::find(variants[v].settings, param, &std::pair<std::size_t, double>::first);
    if (setting == variants[v].settings.end()) return 0.0;
    const double weight = variants[v].share * std::exp(evidence[v] - top);
    sum += weight;
    square += weight * std::pow(setting->second - value, 2);
  }
  return std::sqrt(square / sum);
}

double settings_apart(const Fitted& nominal, const Choice& choice, std::size_t param) {
  const auto& variants = nominal.set.candidates[choice.candidate].variants;
  const double own = value_of(variants[choice.variant], param);
  double apart = std::numeric_limits<double>::infinity();
  for (const inference::Variant& v : variants)
    if (const double off = std::abs(value_of(v, param) - own); off > 0.0)
      apart = std::min(apart, off);
  return std::isfinite(apart) ? apart : 0.0;
}

std::vector<double> credible_settings(const Fitted& nominal, const std::vector<Choice>& choices,
                                      std::size_t which, std::size_t param, double credible) {
  const auto& variants = nominal.set.candidates[choices[which].candidate].variants;
  const std::vector<double> evidence = evidence_of_settings(nominal, choices, which);
  const double top = std::ranges::max(evidence);
  std::map<double, double> weight;
  double sum = 0.0;
  for (std::size_t v = 0; v < variants.size() && top != never; ++v) {
    const double w = variants[v].share * std::exp(evidence[v] - top);
    weight[value_of(variants[v], param)] += w;
    sum += w;
  }
  std::vector<std::pair<double, double>> by_weight(weight.begin(), weight.end());
  std::ranges::stable_sort(by_weight, std::greater{}, &std::pair<double, double>::second);
  std::set<double> values{value_of(variants[choices[which].variant], param)};
  double held = 0.0;
  for (const auto& [value, w] : by_weight) {
    if (held >= credible * sum) break;
    held += w;
    values.insert(value);
  }
  return {values.begin(), values.end()};
}

}  // namespace drift::search
