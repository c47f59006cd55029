#include <algorithm>
#include <cmath>

#include "analysis/report/diagnosis/sections.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "analysis/report/svg/curve.hpp"
#include "analysis/report/svg/figure.hpp"
#include "analysis/report/svg/heat_map.hpp"
#include "analysis/report/svg/zoomable.hpp"

namespace drift::report {
namespace {

using namespace diagnosis;
using namespace inference;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Heat map of channels and positions.
Blocks heat_figure(const Where& where, bool consistent) {
  if (where.heat.empty() || where.channel_names.empty()) return {};
  const int positions = std::ranges::max(where.heat, {}, &HeatCell::position).position;
  HeatMap map;
  map.title = consistent ? "What the nominal model leaves" : "Where the misfit is";
  map.x_label = "position";
  map.value_label = consistent ? "chi-square per degree of freedom above or below 1"
                               : "share of the located misfit [%]";
  map.rows = where.channel_names;
  for (int p = 1; p <= positions; ++p) map.columns.push_back(fmt::format("{}", p));
  map.value = MatX::Constant(static_cast<Eigen::Index>(map.rows.size()), positions, none);
  for (const HeatCell& c : where.heat)
    if (c.channel >= 0 && c.channel < map.value.rows() && c.position >= 1)
      map.value(c.channel, c.position - 1) = consistent
                                                 ? 0.01 * std::round(100.0 * (c.chi2_per_dof - 1.0))
                                                 : std::round(100.0 * c.share);
  if (consistent) map.most = 1.0;
  return {figure_of(
      std::move(map),
      consistent ? "Residuals of each channel and position against their noise. Cells of few "
                   "samples scatter; together they show nothing significant."
                 : "Share of each channel and position in the misfit that the nominal model "
                   "leaves. Negative shares speak against the located effect, or are less than "
                   "noise leaves where nothing explains it.",
      "where.svg")};
}

/// Whether most positions hold several samples: then curves are not joined from one to the next.
bool has_stretches(const std::vector<int>& position) {
  std::size_t changes = 0;
  for (std::size_t i = 1; i < position.size(); ++i)
    changes += position[i] != position[i - 1] ? 1 : 0;
  return 2 * changes < position.size();
}

void append(Series& series, bool new_position, double x, double y, double sigma) {
  if (new_position && !series.x.empty()) append(series, false, x, none, none);
  series.x.push_back(x);
  series.y.push_back(y);
  series.sigma.push_back(sigma);
}

/// At most so many located windows, from bottom to top of the panel.
std::vector<ExpectedBand> located(const Where& where, const RecoveredSignal& s, double unit,
                                  const Range& range) {
  constexpr std::size_t most = 6;
  const double low = range.low - range.width(), high = range.high + range.width();
  std::vector<ExpectedBand> bands;
  for (const ScanHit& w : where.windows)
    if (w.equation == s.equation && bands.size() < most)
      bands.push_back({"located window",
                       {w.start_s / unit, w.end_s / unit},
                       {low, low},
                       {high, high},
                       Shade::located});
  return bands;
}

Panel signal_panel(const RecoveredSignal& s, const Where& where) {
  const TimeAxis axis = time_axis(s.t, where);
  Panel panel;
  panel.title = equation_in_words(s.equation);
  panel.x_label = axis.label;
  panel.y_label = fmt::format("missing input [{}]", s.unit);
  Series found = curve("recovered, with 1 sigma", 0),
         explained = curve("signature of the cause", 1);
  Range range;
  const bool apart = has_stretches(s.position);
  for (std::size_t i = 0; i < s.value.size(); ++i) {
    const bool next = apart && i > 0 && i < s.position.size() && s.position[i] != s.position[i - 1];
    const double sigma = i < s.sigma.size() ? s.sigma[i] : 0.0, t = s.t[i] / axis.unit;
    append(found, next, t, s.value[i], sigma);
    range.include(s.value[i] - sigma);
    range.include(s.value[i] + sigma);
    if (i < s.explained.size()) {
      append(explained, next, t, s.explained[i], 0.0);
      range.include(s.explained[i]);
    }
  }
  explained.sigma.clear();
  if (range.empty()) {
    panel.note = "nothing recovered";
    return panel;
  }
  panel.y_range = range;
  panel.expected = located(where, s, axis.unit, range);
  panel.series.push_back(std::move(found));
  if (!explained.x.empty()) panel.series.push_back(std::move(explained));
  panel.references.push_back({0.0, "", Stroke::dotted});
  return panel;
}

/// The recovered signals with band, located windows and the winner's signature.
Blocks signal_figure(const Diagnosis& d) {
  constexpr std::size_t most = 3;
  Chart chart{"What the nominal model does not explain", {}, 1, 900.0, 270.0};
  for (std::size_t k = 0; k < std::min(most, d.signals.size()); ++k)
    chart.panels.push_back(signal_panel(d.signals[k], d.where));
  if (chart.panels.empty()) return {};
  const bool shaded =
      std::ranges::any_of(chart.panels, [](const Panel& panel) { return !panel.expected.empty(); });
  const bool with_cause =
      std::ranges::any_of(chart.panels, [](const Panel& panel) { return panel.series.size() > 1; });
  return {zoomable(
      chart,
      fmt::format("The input that would explain the misfit, as a time series{}.{}",
                  shaded ? "; shaded: the located window" : "",
                  with_cause ? " The signature of the cause is what the fitted parameters cannot "
                               "absorb."
                             : ""),
      "signal.svg")};
}

}  // namespace

TimeAxis time_axis(const std::vector<double>& t, const Where& where) {
  const bool in_hours = time_unit(t) == TimeUnit::hours;
  return {in_hours ? 3600.0 : 1.0,
          fmt::format("time{} [{}]", where.recordings.empty() ? "" : " through all recordings",
                      in_hours ? "h" : "s")};
}

Table window_table(const Where& where, TimeUnit axes) {
  const bool in_hours = axes == TimeUnit::hours;  // to people; machines read seconds
  Table table("Located windows",
              fmt::format("equation=<equation | position=position | start_s=from [{0}] | "
                          "end_s=to [{0}] | score=score | p_value=p",
                          in_hours ? "h" : "s"));
  if (!where.recordings.empty())
    table.add_columns(
        "recording=<recording | start_in_recording_s= | end_in_recording_s= | <there [s]");
  table.limit = {.page = 12, .rest_in = "diagnosis.json"};
  const auto time = [&](double s) {
    return in_hours ? Cell(s, decimal_text(s / 3600.0, 3)) : decimals(s, 0);
  };
  for (const ScanHit& w : where.windows) {
    std::vector<Cell> cells{w.equation,
                            Cell(w.position, w.position > 0 ? fmt::format("{}", w.position) : ""),
                            time(w.start_s),
                            time(w.end_s),
                            w.T,
                            p_cell(w.p_value)};
    if (const RecordingSpan* r = recording_at(where.recordings, 0.5 * (w.start_s + w.end_s))) {
      const double start = w.start_s - r->offset_s, end = w.end_s - r->offset_s;
      cells.insert(cells.end(), {r->name, only_value(start), only_value(end),
                                 fmt::format("{:.0f} to {:.0f}", start, end)});
    }
    table.add(std::move(cells));
  }
  return table;
}

Section where(const Diagnosis& d) {
  Section section{"Where", {}, On::page};
  if (const auto sentence = where_sentence(d.where, time_unit(d)); !sentence.empty())
    section.add({Paragraph{sentence}});
  section.add(heat_figure(d.where, d.verdict == Verdict::consistent));
  section.add(signal_figure(d));
  for (const RecoveredSignal& s : d.signals)
    if (const std::string shape = shape_text(s, d.where.recordings); !shape.empty())
      section.add({Paragraph{fmt::format("{}: {}", s.equation, shape)}});
  return section;
}

Section windows(const Diagnosis& d) {
  if (d.where.windows.empty()) return {};
  return {"Located windows", {window_table(d.where, time_unit(d))}, On::page};
}

}  // namespace drift::report
