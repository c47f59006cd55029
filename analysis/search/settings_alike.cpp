#include "analysis/search/settings_alike.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/inference/size_prior.hpp"

namespace drift::search {
namespace {

/// The point of the grid for which a fit at variant `own` stands: itself, or the better of those
/// that it lies between.
std::size_t point_of(const std::vector<inference::Variant>& variants,
                     const std::vector<double>& evidence, std::size_t own) {
  if (!variants[own].between) return own;
  std::size_t below = own, above = own;
  while (below > 0 && variants[below].between) --below;
  while (above + 1 < variants.size() && variants[above].between) ++above;
  if (variants[below].between) return above;
  if (variants[above].between) return below;
  return evidence[below] > evidence[above] ? below : above;
}

double log_share(const Fitted& nominal, const Explanation& choices, std::size_t which) {
  const auto& variants = nominal.set.candidates[choices[which].candidate].variants;
  if (variants.size() == 1) return 0.0;
  const std::size_t own = choices[which].variant;
  const std::vector<double> evidence = evidence_of_settings(nominal, choices, which);
  const std::size_t point = point_of(variants, evidence, own);
  double points = 0.0, alike = 1.0;
  for (std::size_t v = 0; v < variants.size(); ++v) {
    if (variants[v].between || !std::isfinite(evidence[v])) continue;
    points += 1.0;
    if (v != point && std::isfinite(evidence[own]))
      alike += std::min(1.0, std::exp(evidence[v] - evidence[own]));
  }
  return std::log(alike / std::max(1.0, points));
}

}  // namespace

double log_share_of_settings(const Fitted& nominal, const Explanation& choices) {
  double sum = 0.0;
  for (std::size_t k = 0; k < choices.size(); ++k) sum += log_share(nominal, choices, k);
  return sum;
}

BestSetting best_setting(const inference::CandidateSet& set, const inference::Projector& projector,
                         std::size_t candidate) {
  BestSetting best;
  double top = never, sum = never, whole = 0.0;
  const auto& variants = set.candidates[candidate].variants;
  for (std::size_t v = 0; v < variants.size(); ++v) {
    const inference::Projected p = projector.candidates(variants[v].columns);
    const double evidence = inference::log_evidence_of_sizes(p.C, p.g);
    whole += variants[v].share;
    sum = log_sum(sum, evidence + std::log(variants[v].share));
    if (evidence <= top) continue;
    top = evidence;
    best.variant = v;
  }
  best.log_evidence = sum - std::log(whole);
  best.log_all_against_this = best.log_evidence - top;
  return best;
}

}  // namespace drift::search
