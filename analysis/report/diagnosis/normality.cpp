#include <algorithm>
#include <cmath>

#include "analysis/report/diagnosis/sections.hpp"
#include "analysis/report/svg/curve.hpp"
#include "analysis/report/svg/zoomable.hpp"
#include "core/stats/normal.hpp"

namespace drift::report {
namespace {

constexpr std::size_t most_quantiles = 150;

/// Of one channel, before and after, with the line of a standard normal number.
Panel quantile_panel(const diagnosis::Diagnosis& d, Eigen::Index channel) {
  Panel panel;
  panel.title = channel_in_words(d.where.channel_names[static_cast<std::size_t>(channel)]);
  panel.x_label = "quantile of a normal number";
  panel.y_label = "residual [sigma]";
  const auto add = [&](const MatX& residual, const char* label, std::size_t colour, Stroke stroke) {
    Series s = curve(label, colour, stroke);
    for (const auto& [normal, found] : normal_quantiles(residual, channel)) {
      s.x.push_back(normal);
      s.y.push_back(found);
    }
    panel.series.push_back(std::move(s));
  };
  add(d.fit.residual_before, "nominal model", 1, Stroke::solid);
  if (d.has_patch && d.fit.residual_after.cols() == d.fit.residual_before.cols())
    add(d.fit.residual_after, "with the cause", 0, Stroke::solid);
  if (!panel.series.front().x.empty()) {
    Series line = curve("noise as declared", 6, Stroke::dashed);
    line.x = {panel.series.front().x.front(), panel.series.front().x.back()};
    line.y = line.x;
    panel.series.push_back(std::move(line));
  }
  return panel;
}

}  // namespace

std::vector<std::pair<double, double>> normal_quantiles(const MatX& residual,
                                                        Eigen::Index channel) {
  std::vector<double> sorted;
  for (const double v : residual.row(channel))
    if (std::isfinite(v)) sorted.push_back(v);
  std::ranges::sort(sorted);
  if (sorted.size() < 2) return {};
  // At even steps of the normal number, the ends among them: there outliers are seen.
  const double n = static_cast<double>(sorted.size());
  const double end = stats::normal_quantile(1.0 - 0.5 / n);
  std::vector<std::pair<double, double>> all;
  std::size_t next = 0;
  for (std::size_t k = 0; k < most_quantiles; ++k) {
    const double z = end * (2.0 * static_cast<double>(k) / (most_quantiles - 1.0) - 1.0);
    const double at = std::clamp(std::round(n * stats::normal_distribution(z) - 0.5), 0.0, n - 1.0);
    const auto i = static_cast<std::size_t>(at);
    if (i < next) continue;  // had already
    next = i + 1;
    all.emplace_back(stats::normal_quantile((at + 0.5) / n), sorted[i]);
  }
  return all;
}

/// Whether what is left is distributed like noise: quantiles of the residuals against normal ones.
Section normality(const diagnosis::Diagnosis& d) {
  if (d.fit.residual_before.cols() < 8) return {};
  Chart chart{"Quantiles of the residuals", {}, 3, 360.0, 240.0};
  const auto channels = std::min<Eigen::Index>(6, std::ssize(d.where.channel_names));
  for (Eigen::Index c = 0; c < channels; ++c)
    if (d.fit.residual_before.row(c).array().isFinite().any())
      chart.panels.push_back(quantile_panel(d, c));
  if (chart.panels.empty()) return {};
  return {"Is what is left normal noise?",
          {figure_of(chart,
                     "Residuals of every channel, sorted, against the quantiles of normal noise as "
                     "declared, which lie on the dashed line. Steeper: more noise than declared; "
                     "ends that bend away: outliers; a curve that lies beside the line: an offset.",
                     "quantiles.svg")},
          On::page};
}

}  // namespace drift::report
