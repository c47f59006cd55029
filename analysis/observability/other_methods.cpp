#include "analysis/observability/other_methods.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>

namespace drift::observability {

/// Declares the methods and lists them in the order of the report. A new one is its file and its
/// name here.
#define DRIFT_METHODS(list, ...)              \
  std::type_identity_t<Method()> __VA_ARGS__; \
  static constexpr Method (*list[])() = {__VA_ARGS__}
DRIFT_METHODS(methods, conditional, svd, ham_brown);
#undef DRIFT_METHODS

VecX ranks_of(const VecX& score) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(score.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::ranges::stable_sort(order, std::greater{}, [&](Eigen::Index k) { return score[k]; });
  VecX ranks(score.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first + 1;
    const double best = score[order[first]];
    while (end < order.size() && best - score[order[end]] <= 1e-9 * std::abs(best)) ++end;
    for (std::size_t i = first; i < end; ++i)
      ranks[order[i]] = 0.5 * static_cast<double>(first + 1 + end);
    first = end;
  }
  return ranks;
}

double spearman(const VecX& a, const VecX& b) {
  const VecX x = ranks_of(a).array() - 0.5 * static_cast<double>(a.size() + 1);
  const VecX y = ranks_of(b).array() - 0.5 * static_cast<double>(b.size() + 1);
  return x.dot(y) / (x.norm() * y.norm());
}

namespace {

/// The worst three, if beyond a quarter of all.
std::vector<MethodRanking::Disagreement> disagreements(const Method& method, const Ranked& ranked,
                                                       const VecX& here, const VecX& primary) {
  const auto n = static_cast<std::size_t>(here.size());
  std::vector<std::size_t> worst(n);
  std::iota(worst.begin(), worst.end(), std::size_t{0});
  const auto apart = [&](std::size_t k) { return std::abs(here[k] - primary[k]); };
  std::ranges::stable_sort(worst, std::greater{}, apart);
  std::vector<MethodRanking::Disagreement> out;
  for (const std::size_t k : worst) {
    if (out.size() == 3 || apart(k) < 0.25 * static_cast<double>(n)) break;
    out.push_back({k, here[k], primary[k], method.reason(ranked, k, here[k] < primary[k])});
  }
  return out;
}

}  // namespace

std::vector<MethodRanking> compare_methods(const Ranked& ranked) {
  VecX learned(static_cast<Eigen::Index>(ranked.ranking.layout.size()));
  for (Eigen::Index k = 0; k < learned.size(); ++k)
    learned[k] = -ranked.parameter(static_cast<std::size_t>(k)).learning_ratio();
  const VecX primary = ranks_of(learned);
  std::vector<MethodRanking> all;
  for (const auto of : methods) {
    const Method method = of();
    const VecX score = method.score(ranked);
    all.push_back({method.key, method.words, score, spearman(score, learned),
                   disagreements(method, ranked, ranks_of(score), primary)});
  }
  return all;
}

}  // namespace drift::observability
