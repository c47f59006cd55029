#include "analysis/search/scores/field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "analysis/inference/size_prior.hpp"
#include "core/base/decompose.hpp"

namespace drift::search {

Field::Field(inference::CandidateSet candidates, inference::Projected p,
             std::vector<inference::PositionScan> windows)
    : set(std::move(candidates)), projected(std::move(p)), scans(std::move(windows)) {
  for (const inference::Candidate& c : set.candidates) {
    contrasts.emplace_back();
    for (const inference::Variant& v : c.variants)
      contrasts.back().push_back(inference::make_contrast(projected.C, projected.raw, v.columns));
  }
}

std::vector<inference::Contrast> Field::all_contrasts() const {
  std::vector<inference::Contrast> all;
  for (const auto& c : contrasts) all.insert(all.end(), c.begin(), c.end());
  return all;
}

double log_bayes(const inference::Projected& p, const std::vector<int>& columns) {
  return inference::log_evidence_of_sizes(p.C(columns, columns), p.g(columns));
}

namespace {

/// Log of the average of exp(logs) by the shares.
double log_average(const std::vector<double>& logs, const std::vector<double>& share) {
  const double top = *std::max_element(logs.begin(), logs.end());
  if (!std::isfinite(top)) return top;
  const double whole = std::accumulate(share.begin(), share.end(), 0.0);
  double sum = 0.0;
  for (std::size_t k = 0; k < logs.size(); ++k) sum += std::exp(logs[k] - top) * share[k] / whole;
  return top + std::log(sum);
}

}  // namespace

Score score(const Field& field, std::size_t candidate) {
  Score best;
  best.strength = -1.0;
  const inference::Candidate& c = field.set.candidates[candidate];
  std::vector<double> evidence, visible, seen_share, share;
  for (std::size_t v = 0; v < c.variants.size(); ++v) {
    const inference::Contrast& contrast = field.contrasts[candidate][v];
    const double T = std::max(0.0, contrast.T(field.projected.g) - field.discount_of(candidate));
    const double s = stats::strength(T, contrast.dof);
    if (contrast.dof > 0 && s > best.strength) {
      best.variant = v;
      best.T = T;
      best.strength = s;
      best.dof = contrast.dof;
    }
    if (contrast.dof == 0) continue;  // an onset after the end of the test is no effect
    const double priors_alone = 0.5 * field.discount_of(candidate);
    const std::vector<int>& columns = c.variants[v].columns;
    const inference::VisibleEvidence seen = inference::evidence_of_visible_sizes(
        field.projected.C(columns, columns), field.projected.g(columns));
    evidence.push_back(log_bayes(field.projected, columns) - priors_alone);
    visible.push_back(seen.log + std::log(seen.share) - priors_alone);
    seen_share.push_back(std::log(seen.share));
    share.push_back(c.variants[v].share);
  }
  best.strength = std::max(best.strength, 0.0);
  if (evidence.empty()) return best;
  best.log_bayes = log_average(evidence, share);
  const double log_visible = log_average(seen_share, share);
  best.visible = std::exp(log_visible);
  if (best.visible > 0.0) best.log_bayes_visible = log_average(visible, share) - log_visible;
  return best;
}

std::vector<double> evidence_of_settings(const Field& field, const Explanation& choices,
                                         std::size_t which) {
  const std::size_t k = choices[which].candidate;
  Explanation tried = choices;
  std::vector<double> evidence;
  for (std::size_t v = 0; v < field.set.candidates[k].variants.size(); ++v) {
    tried[which].variant = v;
    evidence.push_back(field.contrasts[k][v].dof == 0
                           ? -std::numeric_limits<double>::infinity()
                           : log_bayes(field.projected, distinct_columns_of(field.set, tried)));
  }
  return evidence;
}

std::vector<std::size_t> best_of(const std::vector<double>& evidence, double nearly,
                                 std::size_t most) {
  const double top = *std::max_element(evidence.begin(), evidence.end());
  std::vector<std::size_t> found;
  for (std::size_t v = 0; v < evidence.size(); ++v) {
    const bool below_next = v + 1 < evidence.size() && evidence[v + 1] > evidence[v];
    const bool below_last = v > 0 && evidence[v - 1] >= evidence[v];
    if (!below_next && !below_last && evidence[v] >= top - nearly) found.push_back(v);
  }
  std::stable_sort(found.begin(), found.end(),
                   [&](std::size_t a, std::size_t b) { return evidence[a] > evidence[b]; });
  if (found.size() > most) found.resize(most);
  return found;
}

std::vector<std::size_t> best_settings(const Field& field, std::size_t candidate, double nearly,
                                       std::size_t most) {
  return best_of(evidence_of_settings(field, {{candidate, 0}}, 0), nearly, most);
}

VecX expected_amplitudes(const inference::Projected& p, const std::vector<int>& columns) {
  MatX C = p.C(columns, columns);
  C.diagonal().array() += 1.0;
  return solve_symmetric(C, VecX(p.g(columns)));
}

double cosine(const inference::Projected& p, const std::vector<int>& a, const std::vector<int>& b) {
  const inference::Contrast ca = inference::make_contrast(p.C, p.raw, a),
                            cb = inference::make_contrast(p.C, p.raw, b);
  if (ca.dof == 0 || cb.dof == 0) return 0.0;
  const MatX m = ca.W.transpose() * p.C(a, b) * cb.W;
  if (ca.dof == 1 && cb.dof == 1) return m(0, 0);
  return largest_singular_value(m);
}

}  // namespace drift::search
