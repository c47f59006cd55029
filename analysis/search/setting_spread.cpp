#include "analysis/search/setting_spread.hpp"

#include <algorithm>
#include <cmath>

namespace drift::search {

double setting_spread(const Fitted& nominal, const std::vector<Choice>& choices, std::size_t which,
                      std::size_t param, double value) {
  const std::size_t k = choices[which].candidate;
  const auto& variants = nominal.set.candidates[k].variants;
  std::vector<Choice> tried = choices;
  std::vector<double> evidence, share, off;
  for (std::size_t v = 0; v < variants.size(); ++v) {
    if (nominal.contrasts[k][v].dof == 0) continue;
    const auto setting =
        std::ranges::find(variants[v].settings, param, &std::pair<std::size_t, double>::first);
    if (setting == variants[v].settings.end()) return 0.0;
    tried[which].variant = v;
    evidence.push_back(log_bayes(nominal.projected, distinct_columns_of(nominal.set, tried)));
    share.push_back(variants[v].share);
    off.push_back(setting->second - value);
  }
  if (evidence.empty()) return 0.0;
  const double top = *std::ranges::max_element(evidence);
  double sum = 0.0, square = 0.0;
  for (std::size_t v = 0; v < evidence.size(); ++v) {
    const double weight = share[v] * std::exp(evidence[v] - top);
    sum += weight;
    square += weight * off[v] * off[v];
  }
  return std::sqrt(square / sum);
}

}  // namespace drift::search
