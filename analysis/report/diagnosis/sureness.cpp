#include <algorithm>
#include <cmath>

#include "analysis/report/diagnosis/sections.hpp"
#include "analysis/report/diagnosis/words/effect_words.hpp"
#include "analysis/report/svg/curve.hpp"
#include "analysis/report/svg/dumbbell_chart.hpp"
#include "analysis/report/svg/figure.hpp"
#include "analysis/report/svg/zoomable.hpp"
#include "core/physics/closure.hpp"

namespace drift::report {
namespace {

using namespace diagnosis;

/// Share of a channel's variance that its residuals have in common with those `lag` samples later;
/// NaN of too few pairs.
double autocorrelation(const MatX& residual, Eigen::Index channel, Eigen::Index lag) {
  constexpr int fewest = 20;
  double mean = 0.0;
  int n = 0;
  for (const double v : residual.row(channel))
    if (std::isfinite(v)) mean += v, ++n;
  if (n < fewest) return std::nan("");
  mean /= n;
  double power = 0.0, common = 0.0;
  int pairs = 0;
  for (Eigen::Index i = 0; i < residual.cols(); ++i) {
    const double v = residual(channel, i) - mean;
    if (std::isfinite(v)) power += v * v;
    if (i + lag >= residual.cols()) continue;
    const double next = residual(channel, i + lag) - mean;
    if (!std::isfinite(v) || !std::isfinite(next)) continue;
    common += v * next;
    ++pairs;
  }
  return pairs < fewest || !(power > 0.0) ? std::nan("") : (common / pairs) / (power / n);
}

/// Of one channel, before and after, with the band of white noise.
Panel whiteness_panel(const Diagnosis& d, Eigen::Index channel, Eigen::Index most_lag) {
  Panel panel;
  panel.title = channel_in_words(d.where.channel_names[static_cast<std::size_t>(channel)]);
  panel.x_label = "lag [samples]";
  panel.y_label = "autocorrelation";
  const auto add = [&](const MatX& residual, const char* label, std::size_t colour, Stroke stroke) {
    Series s = curve(label, colour, stroke);
    for (Eigen::Index lag = 1; lag <= most_lag; ++lag) {
      s.x.push_back(static_cast<double>(lag));
      s.y.push_back(autocorrelation(residual, channel, lag));
    }
    panel.series.push_back(std::move(s));
  };
  add(d.fit.residual_before, "nominal model", 1, Stroke::solid);
  if (d.has_patch && d.fit.residual_after.cols() == d.fit.residual_before.cols())
    add(d.fit.residual_after, "with the cause", 0, Stroke::dashed);
  double n = 0.0;
  for (const double v : d.fit.residual_before.row(channel)) n += std::isfinite(v) ? 1.0 : 0.0;
  const double half = 1.96 / std::sqrt(n), last = static_cast<double>(most_lag);
  panel.expected.push_back({"95 % of white noise", {1.0, last}, {-half, -half}, {half, half}});
  panel.y_range = Range{-0.5, 1.0};
  return panel;
}

}  // namespace

Blocks cause_figure(const Diagnosis& d) {
  DumbbellChart chart;
  chart.title = d.verdict == Verdict::ambiguous ? "Sizes of the causes that remain possible"
                                                : "Sizes of the causes";
  chart.x_label = "distance from the nominal model [sigma]";
  chart.before_label = "nominal model";
  chart.after_label = "found, with its 95 % interval";
  chart.text_label = "size ± 1 sigma, or its 95 % interval";
  bool settings = false;  // a value of theirs is no distance from a model without the effect
  for (const search::Cause& c : d.causes)
    for (const search::CauseParameter& p : c.parameters) {
      settings = settings || TermLibrary::specs[p.param].setting();
      if (TermLibrary::specs[p.param].setting() || !(p.told_sigma() > 0.0) ||
          !std::isfinite(p.told()))
        continue;
      const auto distance = [&](double value) {
        return (value - value_left_out(p.param, d.nominal.coupling)) / p.told_sigma();
      };
      chart.lines.push_back(
          {.label = fmt::format("{} {}", label_of(c), p.key),
           .before = 0.0,
           .after = distance(p.told()),
           .low = distance(p.low()),
           .high = distance(p.high()),
           .text = fmt::format("{}{}{}", value_in_words(p), p.unit == "1" ? "" : " " + p.unit,
                               p.less_mean ? ", " + note_in_words(p) : "")});
    }
  if (chart.lines.empty()) return {};
  return {figure_of(
      std::move(chart),
      fmt::format("What is found of each parameter of a cause, in its own sigmas, with the "
                  "interval that refits found where there are some. An interval that reaches the "
                  "nominal model: this parameter alone is not needed.{}",
                  settings ? " Settings, such as a width or a time constant, are not shown: none "
                             "of their values is that of a model without the effect."
                           : ""),
      "causes.svg")};
}

Section whiteness(const Diagnosis& d) {
  constexpr Eigen::Index most_lag = 40;
  const MatX& residual = d.fit.residual_before;
  const auto lags = std::min<Eigen::Index>(most_lag, residual.cols() / 4);
  if (lags < 4) return {};
  Chart chart{"Autocorrelation of the residuals", {}, 3, 360.0, 220.0};
  const auto channels = std::min<Eigen::Index>(6, std::ssize(d.where.channel_names));
  for (Eigen::Index c = 0; c < channels; ++c)
    if (residual.row(c).array().isFinite().any())
      chart.panels.push_back(whiteness_panel(d, c, lags));
  if (chart.panels.empty()) return {};
  return {
      "Is what is left white noise?",
      {figure_of(chart,
                 "How much of a residual comes again so many samples later. A right model leaves "
                 "white noise, nearly all within the grey band; what a fit takes up lies a little "
                 "below it.",
                 "whiteness.svg")},
      On::page};
}

}  // namespace drift::report
