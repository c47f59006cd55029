#include "analysis/blind/reliability.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace drift::blind {
namespace {

std::vector<ReliabilityBin> bins_of(const std::vector<TrialScore>& scores) {
  // Finer where answers are sure: that is where most of them lie.
  const double edges[] = {0.0, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95, 0.99, 1.0 + 1e-9};
  std::vector<ReliabilityBin> bins;
  for (std::size_t k = 0; k + 1 < std::size(edges); ++k) {
    std::size_t right = 0, n = 0;
    double stated = 0.0;
    for (const TrialScore& s : scores) {
      const double p = s.answer.belief.probability;
      if (!(p >= edges[k] && p < edges[k + 1])) continue;
      ++n;
      right += s.believed_right;
      stated += p;
    }
    if (n > 0)
      bins.push_back({edges[k], std::min(edges[k + 1], 1.0), stated / static_cast<double>(n),
                      stats::proportion(right, n)});
  }
  return bins;
}

}  // namespace

Reliability reliability_of(const std::vector<TrialScore>& scores) {
  Reliability out{bins_of(scores), 0.0, 0.0};
  double n = 0.0;
  for (const ReliabilityBin& b : out.bins) {
    const auto trials = static_cast<double>(b.right.n);
    n += trials;
    out.error += trials * std::abs(b.stated - b.right.share());
    // Mean of |normal| with the variance of a binomial.
    out.error_by_chance += std::sqrt(2.0 / std::numbers::pi * b.stated * (1.0 - b.stated) * trials);
  }
  out.error = n > 0.0 ? out.error / n : std::nan("");
  out.error_by_chance = n > 0.0 ? out.error_by_chance / n : std::nan("");
  return out;
}

stats::Proportion right_if_named_by_probability(const std::vector<TrialScore>& scores,
                                                double wrong) {
  std::vector<const TrialScore*> sure;
  for (const TrialScore& s : scores)
    if (s.answer.belief.kind == Belief::Kind::named) sure.push_back(&s);
  std::ranges::stable_sort(sure, std::greater{},
                           [](const TrialScore* s) { return s->answer.belief.probability; });
  double expected = 0.0;
  std::size_t right = 0;
  for (const TrialScore* s : sure) {
    expected += 1.0 - s->answer.belief.probability;
    if (expected > wrong * static_cast<double>(scores.size())) break;
    right += s->believed_right;
  }
  return stats::proportion(right, scores.size());
}

}  // namespace drift::blind
