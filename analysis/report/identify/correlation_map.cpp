#include <algorithm>
#include <cmath>

#include "analysis/inference/fit_thresholds.hpp"
#include "analysis/report/identify/correlation.hpp"
#include "analysis/report/identify/sections.hpp"
#include "analysis/report/svg/figure.hpp"
#include "analysis/report/svg/heat_map.hpp"
#include "core/base/nan.hpp"

namespace drift::report {
namespace {

constexpr std::size_t most_parameters = 20, most_pairs = 8;
constexpr double worth_saying = inference::WorthLimits::tied;

HeatMap map_of(const MatX& correlation, const Layout& layout,
               const std::vector<std::size_t>& states) {
  HeatMap map;
  map.value_label = "correlation; on the diagonal nothing is drawn";
  map.most = 1.0;
  const auto n = static_cast<Eigen::Index>(states.size());
  map.value.resize(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    map.rows.push_back(parameter_key(layout, states[static_cast<std::size_t>(i)]));
    for (Eigen::Index j = 0; j < n; ++j) {
      const double r = correlation(static_cast<Eigen::Index>(states[static_cast<std::size_t>(i)]),
                                   static_cast<Eigen::Index>(states[static_cast<std::size_t>(j)]));
      map.value(i, j) = i == j ? nan_value : 0.01 * std::round(100.0 * r);
    }
  }
  map.columns = map.rows;
  return map;
}

/// Of many parameters that are tied no two need be.
std::string said_of_pairs(const std::vector<CorrelatedPair>& pairs, const FilterView& v) {
  const Layout& layout = v.summary.layout;
  const auto tied = std::ranges::count_if(
      pairs, [](const CorrelatedPair& p) { return std::abs(p.correlation) > worth_saying; });
  if (tied == 0)
    return fmt::format("No two parameters are correlated by more than {}{}.", worth_saying,
                       v.summary.unseen.empty()
                           ? ""
                           : fmt::format("; of {} directions of the parameters {}", layout.size(),
                                         unseen_text(v.summary.unseen, root_of(v))));
  std::vector<std::string> first;
  for (std::size_t k = 0; k < std::min<std::size_t>(most_pairs, static_cast<std::size_t>(tied));
       ++k)
    first.push_back(fmt::format("{} and {} {:.3f}", parameter_key(layout, pairs[k].one),
                                parameter_key(layout, pairs[k].other), pairs[k].correlation));
  return fmt::format(
      "{} pair{} correlated by more than {}, of which a sum or difference is known "
      "better than either: {}{}.",
      tied, tied == 1 ? " is" : "s are", worth_saying, fmt::join(first, "; "),
      static_cast<std::size_t>(tied) > first.size() ? "; ..." : "");
}

}  // namespace

MatX correlation_of(const EstimateResult& result) {
  MatX r = result.covariance;
  const VecX sigma = r.diagonal().cwiseSqrt();
  for (Eigen::Index i = 0; i < r.rows(); ++i)
    for (Eigen::Index j = 0; j < r.cols(); ++j) r(i, j) /= sigma[i] * sigma[j];
  return r;
}

std::vector<CorrelatedPair> strongest_pairs(const MatX& correlation) {
  std::vector<CorrelatedPair> pairs;
  for (Eigen::Index i = 0; i < correlation.rows(); ++i)
    for (Eigen::Index j = i + 1; j < correlation.cols(); ++j)
      if (std::isfinite(correlation(i, j)))
        pairs.push_back(
            {static_cast<std::size_t>(i), static_cast<std::size_t>(j), correlation(i, j)});
  std::ranges::stable_sort(pairs, std::greater{},
                           [](const CorrelatedPair& p) { return std::abs(p.correlation); });
  return pairs;
}

/// How the estimates of a filter hang together: the parameters with the strongest correlations.
Section correlations(const FilterView& v) {
  const identification::FilterRun& run = v.id.counted(v.summary);
  const bool batch = run.batch.estimate.covariance.size() > 0;
  const EstimateResult& result = batch ? run.batch.estimate : run.ekf;
  if (result.covariance.rows() < 2) return {};
  const MatX correlation = correlation_of(result);
  const std::vector<CorrelatedPair> pairs = strongest_pairs(correlation);
  if (pairs.empty()) return {};
  std::vector<std::size_t> states;
  for (const CorrelatedPair& pair : pairs)
    for (const std::size_t k : {pair.one, pair.other})
      if (states.size() < most_parameters && std::ranges::find(states, k) == states.end())
        states.push_back(k);
  std::ranges::sort(states, {}, [&](std::size_t k) { return v.summary.layout.params[k]; });
  HeatMap map = map_of(correlation, v.summary.layout, states);
  map.title = fmt::format("Correlations of the estimates of filter {}", v.spec().name);
  const std::string chosen =
      states.size() < v.summary.layout.size()
          ? fmt::format(" The {} of {} parameters with the strongest; all are in covariance.csv.",
                        states.size(), v.summary.layout.size())
          : "";
  return {
      "",
      {figure_of(std::move(map),
                 fmt::format("Posterior correlations, {} from start {}. ±1: only a combination is "
                             "known.{}",
                             batch ? "batch fit" : "EKF", run.start + 1, chosen)),
       Paragraph{said_of_pairs(pairs, v)}},
      On::page};
}

}  // namespace drift::report
