#include <algorithm>
#include <cmath>

#include "analysis/inference/thresholds.hpp"
#include "analysis/report/diagnosis/sections.hpp"
#include "analysis/report/svg/curve.hpp"
#include "analysis/report/svg/dumbbell_chart.hpp"
#include "analysis/report/svg/figure.hpp"
#include "analysis/report/svg/svg_canvas.hpp"
#include "analysis/report/svg/zoomable.hpp"

namespace drift::report {
namespace {

using namespace diagnosis;

/// What the refit gains, and whether that is what was expected of it.
std::string gain_note(const Diagnosis& d) {
  const FitComparison& f = d.fit;
  if (!std::isfinite(f.log_likelihood_ratio) || f.log_likelihood_ratio == 0.0) return "";
  // From one drift equation to the other is no small step: what is seen near the first says nothing
  // of it.
  const bool small_step =
      std::ranges::none_of(d.causes, [](const search::Cause& c) { return c.term == closure_term; });
  return fmt::format(
      "The refit with the cause gains {} in twice the log likelihood{}.",
      number_text(f.log_likelihood_ratio),
      small_step && std::isfinite(f.linear_T)
          ? fmt::format("; what the nominal model left over had let expect {}{}",
                        number_text(f.linear_T), f.sign_agrees ? "" : ", with the other sign")
          : "");
}

/// Without a cause in the model there is nothing to compare with.
Table fit_table(const Diagnosis& d) {
  const FitComparison& f = d.fit;
  Table table(d.has_patch ? "Before and after" : "The nominal fit",
              d.has_patch ? "< | nominal | with the cause | <expected" : "< | nominal | <expected",
              gain_note(d));
  const auto line = [&](const char* what, double before, double after, std::string expected) {
    if (!std::isfinite(before) && !std::isfinite(after)) return;
    std::vector<Cell> cells{what, digits(before, 4)};
    if (d.has_patch) cells.push_back(digits(after, 4));
    cells.emplace_back(std::move(expected));
    table.add(std::move(cells));
  };
  line("chi-square per degree of freedom", f.chi2_per_dof_before, f.chi2_per_dof_after,
       f.band_high > 0.0 ? fmt::format("{:.3f} to {:.3f} (95 %)", f.band_low, f.band_high) : "1");
  line("NIS per degree of freedom", f.whiteness.nis_per_dof_before, f.whiteness.nis_per_dof_after,
       "1");
  line("whiteness of innovations, p (calibrated)", f.whiteness.ljung_box_p_before,
       f.whiteness.ljung_box_p_after,
       fmt::format("above {}", inference::RemarkLimits::whiteness_p));
  if (!f.held_out.folds.empty())
    line("held-out chi-square per degree of freedom", f.held_out.chi2_per_dof_before,
         f.held_out.chi2_per_dof_after, "1");
  if (!f.held_out.recordings.empty())
    line("recordings held out, chi-square per degree of freedom",
         f.held_out.recording_chi2_per_dof_before, f.held_out.recording_chi2_per_dof_after, "1");
  line("start spread, largest ratio", f.start_spread_before, f.start_spread_after, "below 2");
  return table;
}

Blocks held_out_figure(const HeldOut& held, const std::vector<RecordingSpan>& recordings) {
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
      chart.lines.push_back({.label = fold_name(f, recordings),
                             .before = f.chi2_before / n,
                             .after = f.chi2_after / n,
                             .text = std::isfinite(gain) ? fmt::format("{:+.1f}", gain) : ""});
    }
  if (chart.lines.empty()) return {};
  return {
      figure_of(std::move(chart),
                "Each line was predicted by a fit to all the others. At the right: what the cause "
                "gains in the log of the predicted density of these data; positive is better.",
                "held_out.svg")};
}

Blocks moved_figure(const std::vector<ShiftedParameter>& shifted) {
  constexpr std::size_t most = 24;
  DumbbellChart chart;
  chart.title = "Parameters that the missing physics had moved";
  chart.x_label = "shift in sigmas that the nominal fit claimed";
  chart.text_label = "nominal → with the cause";
  for (const ShiftedParameter& p : shifted) {
    if (chart.lines.size() == most) break;
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
  if (chart.lines.empty()) return {};
  return {
      figure_of(std::move(chart),
                "How far each estimate moves once the cause is in the model; the bar is 1 sigma "
                "of the new estimate.",
                "moved.svg")};
}

/// Residuals of a channel, by the nominal model or with the cause.
Panel residual_panel(const MatX& residual, Eigen::Index channel, const std::vector<double>& t,
                     const TimeAxis& axis, double most) {
  const bool timed = static_cast<Eigen::Index>(t.size()) == residual.cols();
  Panel panel;
  panel.x_label = timed ? axis.label : "sample";
  panel.y_label = "residual [sigma]";
  Series s;
  for (Eigen::Index i = 0; i < residual.cols(); ++i) {
    s.x.push_back(timed ? t[static_cast<std::size_t>(i)] / axis.unit : static_cast<double>(i + 1));
    s.y.push_back(residual(channel, i));
  }
  if (!s.x.empty())
    panel.expected.push_back({"2 sigma", {s.x.front(), s.x.back()}, {-2.0, -2.0}, {2.0, 2.0}});
  panel.y_range = Range{-most, most};
  panel.series.push_back(std::move(s));
  return panel;
}

/// The largest residual of a channel, at least 3, up to 1, 2 or 5 times a power of ten: so that the
/// axis has ticks.
double round_limit(const FitComparison& fit, Eigen::Index channel) {
  double most = 3.0;
  for (const auto* r : {&fit.residual_before, &fit.residual_after})
    for (const double v : r->row(channel))
      if (std::isfinite(v)) most = std::max(most, 1.05 * std::abs(v));
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  return power * (most <= 2.0 * power ? 2.0 : most <= 5.0 * power ? 5.0 : 10.0);
}

Blocks residual_figure(const Diagnosis& d) {
  constexpr std::size_t most_windows = 3;
  const FitComparison& fit = d.fit;
  if (fit.residual_before.cols() == 0) return {};
  const std::vector<double>& t =
      fit.residual_t.empty() && !d.signals.empty() ? d.signals.front().t : fit.residual_t;
  const TimeAxis axis = time_axis(t, d.where);
  const bool compared = d.has_patch && fit.residual_after.cols() == fit.residual_before.cols();
  Chart chart{compared ? "Residuals before and after" : "Residuals of the nominal model",
              {},
              2,
              half_sheet,
              190.0};
  const auto add = [&](const MatX& residual, Eigen::Index channel, std::size_t colour,
                       const char* label, std::string title) {
    chart.panels.push_back(residual_panel(residual, channel, t, axis, round_limit(fit, channel)));
    Panel& panel = chart.panels.back();
    panel.title = std::move(title);
    if (residual.cols() == static_cast<Eigen::Index>(t.size()))
      for (const auto& w : d.where.windows) {
        if (panel.expected.size() > most_windows) break;
        panel.expected.push_back({"located window",
                                  {w.start_s / axis.unit, w.end_s / axis.unit},
                                  {panel.y_range->low, panel.y_range->low},
                                  {panel.y_range->high, panel.y_range->high},
                                  Shade::located});
      }
    chart.panels.back().series.front().label = label;
    chart.panels.back().series.front().colour = colour;
  };
  const auto& names = d.where.channel_names;
  for (Eigen::Index c = 0; c < std::min<Eigen::Index>(6, std::ssize(names)); ++c) {
    if (!fit.residual_before.row(c).array().isFinite().any()) continue;
    const std::string name = channel_in_words(names[static_cast<std::size_t>(c)]);
    add(fit.residual_before, c, 1, "nominal model", d.has_patch ? name + ", before" : name);
    if (compared) add(fit.residual_after, c, 0, "with the cause", name + ", after");
  }
  if (chart.panels.empty()) return {};
  return {
      zoomable(chart,
               "Residuals of every channel in sigmas. A concealed effect need not be seen here: "
               "the fitted parameters take most of it up.",
               "residuals.svg")};
}

}  // namespace

Table moved_table(const Diagnosis& d) {
  Table table("Parameters that moved",
              "key=<parameter | before=before | after=after | sigma_after= | unit=<unit | "
              "sigma_before= | shift_sigma=shift [sigma]");
  table.limit = {8, 40, "diagnosis.json"};
  for (const ShiftedParameter& p : d.fit.shifted) {
    const double size = std::abs(p.shift_sigma);
    const Tone tone = size > 5.0 ? Tone::bad : size > 2.0 ? Tone::doubtful : Tone::plain;
    table.add({p.key, plus_minus(p.before, p.sigma_before), plus_minus(p.after, p.sigma_after),
               p.sigma_after, p.unit, p.sigma_before, decimals(p.shift_sigma, 1, tone)});
  }
  return table;
}

Section fit(const Diagnosis& d) {
  Section section{d.has_patch ? "Before and after" : "The nominal fit",
                  {{fit_table(d), shown_of(d)}}};
  if (const auto sentence = held_out_sentence(d.fit.held_out); !sentence.empty())
    section.add({{Paragraph{sentence}, On::page}});
  if (!d.has_patch) section.add({{Paragraph{"No cause is in the model."}, On::page}});
  section.add(held_out_figure(d.fit.held_out, d.where.recordings));
  section.add(residual_figure(d));
  return section;
}

Section moved(const Diagnosis& d) {
  Section section{"Parameters that moved", moved_figure(d.fit.shifted)};
  if (!d.fit.shifted.empty()) section.add({{moved_table(d), shown_of(d)}});
  return section;
}

}  // namespace drift::report
