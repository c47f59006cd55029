#include <algorithm>
#include <cmath>
#include <functional>

#include "analysis/report/study/sections.hpp"
#include "analysis/report/svg/curve.hpp"
#include "analysis/report/svg/zoomable.hpp"
#include "core/base/nan.hpp"

namespace drift::report {
namespace {

using mc::FilterStatistics;

std::size_t layout_index(const FilterStatistics& filter, std::size_t param) {
  const auto& params = filter.columns().layout.params;
  return static_cast<std::size_t>(std::ranges::find(params, param) - params.begin());
}

/// Parameters worth a picture at a point: the worst of each filter, then misalignments.
std::vector<std::size_t> pictured_parameters(const StudyResults& results, std::size_t point) {
  constexpr std::size_t most = 3;
  std::vector<std::size_t> params;
  const auto add = [&](std::size_t p) {
    if (params.size() < most && std::ranges::find(params, p) == params.end()) params.push_back(p);
  };
  const auto& filters = results.statistics[point].filters();
  for (const FilterStatistics& f : filters)
    if (const std::size_t k = worst_parameter(f, claims_of(results)); k < f.errors().size())
      add(f.columns().layout.params[k]);
  for (const FilterStatistics& f : filters)
    for (const auto key : {"eta_x", "xi_x", "D_I_z", "D_F_x"})
      if (const auto p = TermLibrary::find(key); p && layout_index(f, *p) < f.errors().size())
        add(*p);
  return params;
}

/// One parameter of a pair, its errors upwards.
Panel error_panel(const StudyResults& results, const Pair& pair, std::size_t param) {
  Panel panel;
  panel.title = fmt::format("truth {}, filter {}: {}",
                            key_of(results.points[pair.point].study.truth.coupling),
                            statistics_of(results, pair).columns().name, parameter_key(param));
  panel.y_label = fmt::format("error [{}]", parameter_unit(param));
  return panel;
}

/// Error against reported sigma of the first runs; outside the lines at 5 sigma the filter is sure
/// and wrong.
Panel scatter_panel(const StudyResults& results, const Pair& pair, std::size_t param) {
  const FilterStatistics& filter = statistics_of(results, pair);
  const double unit = unit_of(param);
  Panel panel = error_panel(results, pair, param);
  panel.x_label = fmt::format("sigma [{}]", parameter_unit(param));
  const std::size_t k = layout_index(filter, param);
  if (k == filter.errors().size()) {
    panel.note = "not estimated by this filter";
    return panel;
  }
  Series runs = curve("one run", 0);
  Range sigmas;
  for (const mc::Sample& s : filter.samples()[k]) {  // lone dots: a gap after each
    runs.x.insert(runs.x.end(), {s.sigma / unit, nan_value});
    runs.y.insert(runs.y.end(), {s.error / unit, nan_value});
    sigmas.include(s.sigma / unit);
  }
  if (sigmas.empty()) {
    panel.note = "no estimates";
    return panel;
  }
  const double low = 0.98 * sigmas.low, high = 1.02 * sigmas.high;
  for (const auto& [factor, stroke] :
       {std::pair{1.0, Stroke::dotted}, std::pair{5.0, Stroke::dashed}})
    for (const double sign : {-1.0, 1.0}) {
      Series line = curve(fmt::format("{:.0f} sigma", factor), 1, stroke);
      line.x = {low, high};
      line.y = {sign * factor * low, sign * factor * high};
      panel.series.push_back(std::move(line));
    }
  panel.series.push_back(std::move(runs));
  return panel;
}

/// Errors of the traced runs against time, with the filter's 1 sigma band.
Panel convergence_panel(const StudyResults& results, const Pair& pair, std::size_t param) {
  const double unit = unit_of(param);
  Panel panel = error_panel(results, pair, param);
  panel.x_label = "time [h]";
  panel.references.push_back({0.0, "truth", Stroke::dashed});
  Range late;
  for (const TracedRun& traced : results.traces) {
    if (traced.point != pair.point) continue;
    for (const auto& f : traced.trace.filters) {
      const auto at = std::ranges::find(f.layout.params, param);
      if (f.filter != pair.filter || f.start != 0 || at == f.layout.params.end()) continue;
      const auto k = at - f.layout.params.begin();
      Series s = curve(fmt::format("run {}", traced.run), panel.series.size());
      const auto n = f.history.t.size();
      for (std::size_t i = 0; i < n; ++i) {
        const auto column = static_cast<Eigen::Index>(i);
        const double sigma = f.history.sigma(k, column);
        const bool there = sigma > 0.0;  // where the filter has stopped, its history is empty
        const double error =
            f.history.estimate(k, column) - traced.trace.truth[static_cast<Eigen::Index>(param)];
        s.x.push_back(f.history.t[i] / 3600.0);
        s.y.push_back(there ? error / unit : nan_value);
        s.sigma.push_back(there ? sigma / unit : nan_value);
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

/// A panel of each filter and each parameter worth it.
Chart chart_of(const StudyResults& results, std::size_t point, std::string title,
               Panel (*panel_of)(const StudyResults&, const Pair&, std::size_t)) {
  const auto params = pictured_parameters(results, point);
  Chart chart{std::move(title), {}, std::max<std::size_t>(1, params.size())};
  for (std::size_t f = 0; f < results.statistics[point].filters().size(); ++f)
    for (const std::size_t p : params) chart.panels.push_back(panel_of(results, {point, f}, p));
  return chart;
}

}  // namespace

Section scatter(const StudyResults& results) {
  Section section{"Error against sigma", {}, On::page};
  for (const std::size_t p : pictured_points(results))
    section.add(
        {Paragraph{name_of(results, p)},
         figure_of(chart_of(results, p, "Error against sigma", scatter_panel),
                   fmt::format("Error of the first {} runs against the sigma the filter gave "
                               "it. An honest filter stays between the lines at 5 sigma.",
                               FilterStatistics::most_samples))});
  return section;
}

Section convergence(const StudyResults& results) {
  Section section{"Convergence of sample runs", {}, On::page};
  for (std::size_t p = 0; p < results.points.size(); ++p)
    if (std::ranges::find(results.traces, p, &TracedRun::point) != results.traces.end())
      section.add(
          {Paragraph{name_of(results, p)},
           zoomable(chart_of(results, p, "Convergence", convergence_panel),
                    "Error of the EKF's running estimate against time in sample runs, start "
                    "1, with its 1 sigma band. The first swing may be cut off.")});
  return section;
}

}  // namespace drift::report
