#include "analysis/report/diagnosis/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/diagnosis/sentence.hpp"
#include "analysis/report/diagnosis/words.hpp"
#include "analysis/report/svg/bar_chart.hpp"
#include "analysis/report/svg/dumbbell_chart.hpp"
#include "analysis/report/svg/heat_map.hpp"
#include "analysis/report/svg/svg_chart.hpp"
#include "core/base/number_text.hpp"

namespace drift::report {
namespace {

using namespace diagnosis;
using namespace inference;
using namespace search;

constexpr double hour = 3600.0, none = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t most_signals = 3, most_windows = 6, most_bars = 20, most_moved = 24;

/// Short recordings are shown in seconds, long ones in hours.
struct TimeAxis {
  double unit = hour;
  std::string label = "time [h]";
};
TimeAxis time_axis(const std::vector<double>& t, const Where& where) {
  const bool in_hours = t.empty() || t.back() - t.front() > 2.0 * hour;
  return {in_hours ? hour : 1.0,
          fmt::format("time{} [{}]", where.recordings.empty() ? "" : " through all recordings",
                      in_hours ? "h" : "s")};
}

std::optional<Figure> heat_figure(const Where& where, bool consistent) {
  if (where.heat.empty() || where.channel_names.empty()) return std::nullopt;
  int positions = 0;
  for (const HeatCell& c : where.heat) positions = std::max(positions, c.position);
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
  return Figure{
      "where.svg",
      consistent
          ? "Residuals of each channel and position against their noise. Cells of few samples "
            "scatter; "
            "together they show nothing significant."
          : "Share of each channel and position in the misfit that the nominal model leaves. "
            "Negative shares speak against the located effect.",
      svg_of(map)};
}

/// Whether most positions hold several samples: then curves are not joined from one to the next.
bool has_stretches(const std::vector<int>& position) {
  std::size_t changes = 0;
  for (std::size_t i = 1; i < position.size(); ++i)
    changes += position[i] != position[i - 1] ? 1 : 0;
  return 2 * changes < position.size();
}

void append(Series& series, bool new_position, double x, double y, double sigma) {
  if (new_position && !series.x.empty()) {
    series.x.push_back(x);
    series.y.push_back(none);
    series.sigma.push_back(none);
  }
  series.x.push_back(x);
  series.y.push_back(y);
  series.sigma.push_back(sigma);
}

Panel signal_panel(const RecoveredSignal& s, const Where& where) {
  const TimeAxis axis = time_axis(s.t, where);
  Panel panel;
  panel.title = equation_in_words(s.equation);
  panel.x_label = axis.label;
  panel.y_label = fmt::format("missing input [{}]", s.unit);
  Series found{.label = "recovered, with 1 sigma", .x = {}, .y = {}, .sigma = {}, .colour = 0};
  Series explained{.label = "signature of the cause", .x = {}, .y = {}, .sigma = {}, .colour = 1};
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
  const double room = range.width();
  std::size_t shown = 0;
  for (const ScanHit& w : where.windows) {
    if (w.equation != s.equation || ++shown > most_windows) continue;
    panel.expected.push_back({"located window",
                              {w.start_s / axis.unit, w.end_s / axis.unit},
                              {range.low - room, range.low - room},
                              {range.high + room, range.high + room}});
  }
  panel.series.push_back(std::move(found));
  if (!explained.x.empty()) panel.series.push_back(std::move(explained));
  panel.references.push_back({0.0, "", Stroke::dotted});
  return panel;
}

Panel residual_panel(const Diagnosis& d, const std::vector<double>& t, Eigen::Index channel,
                     const std::string& name, bool after, double most) {
  const FitComparison& fit = d.fit;
  const auto& r = after ? fit.residual_after : fit.residual_before;
  const TimeAxis axis = time_axis(t, d.where);
  const bool timed = static_cast<Eigen::Index>(t.size()) == r.cols();
  Panel panel;
  panel.title = after ? name + ", after" : d.has_patch ? name + ", before" : name;
  panel.x_label = timed ? axis.label : "sample";
  panel.y_label = "residual [sigma]";
  Series s{.label = after ? "with the cause" : "nominal model",
           .x = {},
           .y = {},
           .sigma = {},
           .colour = after ? 0u : 1u};
  for (Eigen::Index i = 0; i < r.cols(); ++i) {
    s.x.push_back(timed ? t[static_cast<std::size_t>(i)] / axis.unit : static_cast<double>(i + 1));
    s.y.push_back(r(channel, i));
  }
  if (!s.x.empty())
    panel.expected.push_back({"2 sigma", {s.x.front(), s.x.back()}, {-2.0, -2.0}, {2.0, 2.0}});
  panel.y_range = Range{-most, most};
  panel.series.push_back(std::move(s));
  return panel;
}

std::optional<Figure> residual_figure(const Diagnosis& d) {
  const FitComparison& fit = d.fit;
  if (fit.residual_before.cols() == 0) return std::nullopt;
  const std::vector<double>& t =
      fit.residual_t.empty() && !d.signals.empty() ? d.signals.front().t : fit.residual_t;
  Chart chart;
  const bool compared = d.has_patch && fit.residual_after.cols() == fit.residual_before.cols();
  chart.title = compared ? "Residuals before and after" : "Residuals of the nominal model";
  chart.columns = 2;
  chart.panel_width = 520.0;
  chart.panel_height = 190.0;
  const auto names = d.where.channel_names;
  for (Eigen::Index c = 0; c < std::min<Eigen::Index>(6, static_cast<Eigen::Index>(names.size()));
       ++c) {
    double most = 3.0;
    for (const auto* r : {&fit.residual_before, &fit.residual_after})
      for (const double v : r->row(c))
        if (std::isfinite(v)) most = std::max(most, 1.05 * std::abs(v));
    if (!fit.residual_before.row(c).array().isFinite().any()) continue;
    const double power =
        std::pow(10.0, std::floor(std::log10(most)));  // round, so that the axis has ticks
    most = power * (most <= 2.0 * power ? 2.0 : most <= 5.0 * power ? 5.0 : 10.0);
    chart.panels.push_back(
        residual_panel(d, t, c, names[static_cast<std::size_t>(c)], false, most));
    if (compared)
      chart.panels.push_back(
          residual_panel(d, t, c, names[static_cast<std::size_t>(c)], true, most));
  }
  if (chart.panels.empty()) return std::nullopt;
  return Figure{
      "residuals.svg",
      "Residuals of every channel in sigmas. A concealed effect need not be seen here: the "
      "fitted parameters take most of it up.",
      svg_of(chart)};
}

std::optional<Figure> held_out_figure(const HeldOut& held) {
  DumbbellChart chart;
  chart.title = "Prediction of data held out of the fit";
  chart.x_label = "chi-square per degree of freedom (logarithmic)";
  chart.before_label = "nominal model";
  chart.after_label = "with the cause";
  chart.text_label = "gain of log density";
  chart.spacing = Spacing::logarithmic;
  chart.limit = ReferenceLine{1.0, "noise alone", Stroke::dashed};
  for (const auto* folds : {&held.folds, &held.recordings})
    for (const Fold& f : *folds) {
      if (f.dof == 0) continue;
      const double n = static_cast<double>(f.dof), gain = f.log_score_after - f.log_score_before;
      chart.lines.push_back({.label = f.name,
                             .before = f.chi2_before / n,
                             .after = f.chi2_after / n,
                             .text = std::isfinite(gain) ? fmt::format("{:+.1f}", gain) : ""});
    }
  if (chart.lines.empty()) return std::nullopt;
  return Figure{"held_out.svg",
                "Each line was predicted by a fit to all the others. At the right: what the cause "
                "gains in the log of the "
                "predicted density of these data; positive is better.",
                svg_of(chart)};
}

std::optional<Figure> moved_figure(const std::vector<ShiftedParameter>& shifted) {
  DumbbellChart chart;
  chart.title = "Parameters that the missing physics had moved";
  chart.x_label = "shift in sigmas that the nominal fit claimed";
  chart.text_label = "nominal → with the cause";
  for (const ShiftedParameter& p : shifted) {
    if (chart.lines.size() == most_moved) break;
    if (!std::isfinite(p.shift_sigma) || !(p.sigma_before > 0.0)) continue;
    const double half = p.sigma_after / p.sigma_before;
    chart.lines.push_back({.label = p.key,
                           .before = 0.0,
                           .after = p.shift_sigma,
                           .low = p.shift_sigma - half,
                           .high = p.shift_sigma + half,
                           .text = fmt::format("{} → {} {}", to_match(p.before, p.sigma_before),
                                               with_sigma(p.after, p.sigma_after), p.unit)});
  }
  if (chart.lines.empty()) return std::nullopt;
  return Figure{
      "moved.svg",
      "How far each estimate moves once the cause is in the model; the bar is 1 sigma of the "
      "new estimate.",
      svg_of(chart)};
}

void add(std::vector<Figure>& figures, std::optional<Figure> figure) {
  if (figure) figures.push_back(std::move(*figure));
}

}  // namespace

std::vector<Figure> where_figures(const Diagnosis& d) {
  std::vector<Figure> figures;
  add(figures, heat_figure(d.where, d.verdict == Verdict::consistent));
  Chart chart;
  chart.title = "What the nominal model does not explain";
  chart.panel_width = 900.0;
  chart.panel_height = 270.0;
  for (std::size_t k = 0; k < std::min(most_signals, d.signals.size()); ++k)
    chart.panels.push_back(signal_panel(d.signals[k], d.where));
  if (!chart.panels.empty())
    figures.push_back(
        {"signal.svg",
         "The input that would explain the misfit, as a time series; grey: the located "
         "window. The signature of the cause is what the fitted parameters cannot absorb.",
         svg_of(chart)});
  return figures;
}

std::vector<Figure> name_figures(const Diagnosis& d) {
  std::vector<Figure> figures;
  BarChart bars;
  bars.title = "Candidates";
  bars.x_label = "projected score, chi-square";
  bars.width = 860.0;
  const bool named = d.verdict == Verdict::named;
  for (const auto& [c, alternative] : shown_candidates(d, most_bars)) {
    if (!std::isfinite(c->score)) continue;
    const std::string what = alternative == 0 ? ""
                             : named          ? ", named"
                                              : fmt::format(", alternative {}", alternative);
    bars.bars.push_back(
        {.label = label_of(*c),
         .value = c->score,
         .colour = alternative > 0 ? 1u : 6u,
         .text = fmt::format("{}, p {}{}", number_text(c->score), p_text(c->p_value), what)});
  }
  if (!bars.bars.empty())
    figures.push_back(
        {"candidates.svg",
         d.causes.empty()
             ? "Strength of the strongest candidates, each alone, after what the fitted parameters "
               "absorb."
             : "Strength of the strongest candidates, each alone, after what the fitted parameters "
               "absorb. Orange: the causes of the verdict, always shown.",
         svg_of(bars)});
  const CosineMatrix& m = d.cosines;
  if (m.cosine.rows() > 1 && m.cosine.rows() == static_cast<Eigen::Index>(m.labels.size())) {
    HeatMap map;
    map.title = "Likeness of the causes on this plan";
    map.value_label = "cosine of the projected signatures: ±1 cannot be told apart";
    map.rows = map.columns = m.labels;
    map.value = m.cosine;
    map.most = 1.0;
    figures.push_back(
        {"cosines.svg", "Cosines between what is left of the signatures.", svg_of(map)});
  }
  return figures;
}

std::vector<Figure> fit_figures(const Diagnosis& d) {
  std::vector<Figure> figures;
  add(figures, held_out_figure(d.fit.held_out));
  add(figures, moved_figure(d.fit.shifted));
  add(figures, residual_figure(d));
  return figures;
}

}  // namespace drift::report
