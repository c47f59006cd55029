#include "analysis/report/study/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "analysis/report/svg/bar_chart.hpp"
#include "core/base/number_text.hpp"
#include "core/physics/coupling_text.hpp"

namespace drift::report {
namespace {

using mc::ErrorStatistics;
using mc::FilterStatistics;

constexpr std::size_t most_pictured = 3;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string pair_label(const StudyResults& results, const Pair& pair) {
  const mc::StudyPoint& point = results.points[pair.point];
  const std::string condition = condition_of(point);
  return fmt::format("{} > {}{}{}", key_of(point.study.truth.coupling),
                     statistics_of(results, pair).columns().name, condition.empty() ? "" : ", ",
                     condition);
}

std::size_t layout_index(const FilterStatistics& filter, std::size_t param) {
  const auto& params = filter.columns().layout.params;
  return static_cast<std::size_t>(std::ranges::find(params, param) - params.begin());
}

/// Points as lone dots: a gap after each.
void add_dot(Series& s, double x, double y) {
  s.x.insert(s.x.end(), {x, nan});
  s.y.insert(s.y.end(), {y, nan});
}

Panel scatter_panel(const StudyResults& results, const Pair& pair, std::size_t param) {
  const FilterStatistics& filter = statistics_of(results, pair);
  const auto& spec = TermLibrary::specs[param];
  const double unit = spec.unit.to_si;
  Panel panel;
  panel.title = fmt::format("truth {}, filter {}: {}",
                            key_of(results.points[pair.point].study.truth.coupling),
                            filter.columns().name, spec.key.view());
  panel.x_label = fmt::format("sigma [{}]", spec.unit.symbol.view());
  panel.y_label = fmt::format("error [{}]", spec.unit.symbol.view());
  const std::size_t k = layout_index(filter, param);
  if (k == filter.errors().size()) {
    panel.note = "not estimated by this filter";
    return panel;
  }
  Series runs{.label = "one run", .x = {}, .y = {}, .sigma = {}, .colour = 0};
  Range sigmas;
  for (const mc::Sample& s : filter.samples()[k]) {
    add_dot(runs, s.sigma / unit, s.error / unit);
    sigmas.include(s.sigma / unit);
  }
  if (sigmas.empty()) {
    panel.note = "no estimates";
    return panel;
  }
  const double low = 0.98 * sigmas.low, high = 1.02 * sigmas.high;
  for (const auto& [factor, stroke] :
       {std::pair{1.0, Stroke::dotted}, std::pair{5.0, Stroke::dashed}})
    for (const double sign : {-1.0, 1.0})
      panel.series.push_back({.label = fmt::format("{:.0f} sigma", factor),
                              .x = {low, high},
                              .y = {sign * factor * low, sign * factor * high},
                              .sigma = {},
                              .colour = 1,
                              .stroke = stroke});
  panel.series.push_back(std::move(runs));
  return panel;
}

Panel convergence_panel(const StudyResults& results, const Pair& pair, std::size_t param) {
  const FilterStatistics& filter = statistics_of(results, pair);
  const auto& spec = TermLibrary::specs[param];
  const double unit = spec.unit.to_si;
  Panel panel;
  panel.title = fmt::format("truth {}, filter {}: {}",
                            key_of(results.points[pair.point].study.truth.coupling),
                            filter.columns().name, spec.key.view());
  panel.x_label = "time [h]";
  panel.y_label = fmt::format("error [{}]", spec.unit.symbol.view());
  panel.references.push_back({0.0, "truth", Stroke::dashed});
  Range late;
  for (const TracedRun& traced : results.traces) {
    if (traced.point != pair.point) continue;
    for (const auto& f : traced.trace.filters) {
      const auto at = std::ranges::find(f.layout.params, param);
      if (f.filter != pair.filter || f.start != 0 || at == f.layout.params.end()) continue;
      const auto k = at - f.layout.params.begin();
      Series s{.label = fmt::format("run {}", traced.run),
               .x = {},
               .y = {},
               .sigma = {},
               .colour = panel.series.size()};
      const auto n = f.history.t.size();
      for (std::size_t i = 0; i < n; ++i) {
        const auto column = static_cast<Eigen::Index>(i);
        const double sigma = f.history.sigma(k, column);
        const bool there = sigma > 0.0;  // where the filter has stopped, its history is empty
        const double error =
            f.history.estimate(k, column) - traced.trace.truth[static_cast<Eigen::Index>(param)];
        s.x.push_back(f.history.t[i] / 3600.0);
        s.y.push_back(there ? error / unit : nan);
        s.sigma.push_back(there ? sigma / unit : nan);
        if (there && i > n / 4) {
          late.include((error + sigma) / unit);
          late.include((error - sigma) / unit);
        }
      }
      panel.series.push_back(std::move(s));
    }
  }
  if (panel.series.empty()) panel.note = "no estimates";
  if (!late.empty()) {
    late.include(0.0);
    panel.y_range = Range{late.low - 0.1 * late.width(), late.high + 0.1 * late.width()};
  }
  return panel;
}

}  // namespace

std::vector<std::size_t> pictured_parameters(const StudyResults& results, std::size_t point) {
  std::vector<std::size_t> params;
  const auto add = [&](std::size_t p) {
    if (params.size() < most_pictured && std::ranges::find(params, p) == params.end())
      params.push_back(p);
  };
  const auto& filters = results.statistics[point].filters();
  for (const FilterStatistics& f : filters)
    if (const std::size_t k = worst_parameter(f, results.study.monte_carlo.healthy_sigma);
        k < f.errors().size())
      add(f.columns().layout.params[k]);
  for (const FilterStatistics& f : filters)
    for (const auto key : {"eta_x", "xi_x", "D_I_z", "D_F_x"})
      if (const auto p = TermLibrary::find(key); p && layout_index(f, *p) < f.errors().size())
        add(*p);
  return params;
}

Picture silent_failure_picture(const StudyResults& results) {
  BarChart chart{"Silent failures",
                 "share of runs that are wrong and look healthy [%]",
                 {},
                 std::nullopt,
                 860.0};
  for (const Pair& pair : pairs_of(results)) {
    const stats::Rate& rate = statistics_of(results, pair).starts().front().silent;
    chart.bars.push_back({pair_label(results, pair), 100.0 * rate.value(), 100.0 * rate.low(),
                          100.0 * rate.high(),
                          matched(results, pair) ? std::size_t{2} : std::size_t{1}, ""});
  }
  return {
      svg_of(chart),
      "Silent failure rate with its 95 % interval, truth > filter: runs in which some parameter "
      "that "
      "the filter claims to know is more than 5 sigma off while its own statistics look healthy."};
}

Picture ranking_picture(const StudyResults& results, const Pair& pair) {
  const FilterStatistics& filter = statistics_of(results, pair);
  std::vector<std::size_t> order(filter.errors().size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto value = [&](std::size_t k) {
    const double v = filter.errors()[k].rmse().value / filter.errors()[k].prior_sigma();
    return std::isfinite(v) ? v : std::numeric_limits<double>::infinity();
  };
  std::ranges::stable_sort(order, {}, value);
  BarChart chart{fmt::format("Monte Carlo ranking, {}", pair_label(results, pair)),
                 "RMSE / prior sigma",
                 {},
                 ReferenceLine{1.0, "nothing learned", Stroke::dashed},
                 860.0};
  for (const std::size_t k : order) {
    const ErrorStatistics& e = filter.errors()[k];
    const mc::Estimated rmse = e.rmse();
    const double prior = e.prior_sigma();
    chart.bars.push_back(
        {key_at(filter, k), rmse.value / prior, rmse.low / prior, rmse.high / prior, 0,
         fmt::format("{} (sigma {})", number_text(rmse.value / prior), number_text(e.learning()))});
  }
  return {svg_of(chart),
          "Parameters by Monte Carlo RMSE over prior sigma with 95 % bootstrap intervals; in "
          "brackets what "
          "the filter says, sigma over prior sigma. 1: nothing learned; above 1: misled."};
}

Picture scatter_picture(const StudyResults& results, std::size_t point) {
  const auto params = pictured_parameters(results, point);
  Chart chart{"Error against sigma", {}, std::max<std::size_t>(1, params.size())};
  for (std::size_t f = 0; f < results.statistics[point].filters().size(); ++f)
    for (const std::size_t p : params)
      chart.panels.push_back(scatter_panel(results, {point, f}, p));
  return {svg_of(chart),
          fmt::format(
              "Error of the first {} runs against the sigma the filter gave it. An honest filter "
              "stays between the lines at 5 sigma.",
              FilterStatistics::most_samples)};
}

Picture convergence_picture(const StudyResults& results, std::size_t point) {
  const auto params = pictured_parameters(results, point);
  Chart chart{"Convergence", {}, std::max<std::size_t>(1, params.size())};
  for (std::size_t f = 0; f < results.statistics[point].filters().size(); ++f)
    for (const std::size_t p : params)
      chart.panels.push_back(convergence_panel(results, {point, f}, p));
  return {
      svg_of(chart),
      "Error of the EKF's running estimate against time in sample runs, start 1, with its 1 sigma "
      "band. The first swing may be cut off."};
}

}  // namespace drift::report
