#include "analysis/report/svg/bar_chart.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/report/svg/value_axis.hpp"
#include "core/base/number_text.hpp"

namespace drift::report {
namespace {

constexpr double usual_row = 22.0, label_row = 16.0, axis_height = 44.0;  // [px]

/// Bars stand closer where they are so many that a sheet of paper would not take them all: the
/// style prints 1210 px on one (page_style).
double row_of(std::size_t bars) {
  constexpr double closest = 13.0, most = 1210.0 - axis_height - 72.0;  // title, limit, lines [px]
  return std::clamp(most / static_cast<double>(std::max<std::size_t>(bars, 1)), closest, usual_row);
}

std::string text_of(const Bar& bar) {
  if (!bar.text.empty()) return bar.text;
  return std::isfinite(bar.value) ? number_text(bar.value) : "n/a";
}

}  // namespace

std::string svg_of(const BarChart& chart) {
  double label_width = 40.0, value_width = 24.0;
  Range range;
  if (chart.spacing == Spacing::linear) range.include(0.0);
  for (const Bar& b : chart.bars) {
    label_width = std::max(label_width, text_pixels(b.label, label_type));
    value_width = std::max(value_width, text_pixels(text_of(b), small_type));
    for (const double v : {b.value, b.low, b.high}) range.include(spaced(v, chart.spacing));
  }
  if (chart.limit) range.include(spaced(chart.limit->y, chart.spacing));
  const double width = std::max(chart.width, text_pixels(chart.title, 15.0) + 2.0 * canvas_edge);
  const double room = width - value_width - canvas_edge - 8.0;
  const bool above = room - (canvas_edge + label_width + 8.0) < least_plot;  // labels above bars
  const double x0 = canvas_edge + (above ? 0.0 : label_width) + 8.0, w = room - x0;
  const double bar_row = row_of(chart.bars.size()), gap = std::min(4.0, 0.5 * (bar_row - 9.0)),
               under = above ? label_row : 0.0, row = bar_row + under;
  const double y0 = (chart.title.empty() ? 8.0 : 40.0) + (chart.limit ? 16.0 : 0.0);
  const double h = row * static_cast<double>(chart.bars.size());
  const AxisScale scale = make_scale(range, static_cast<int>(w / 60.0), 0.02, chart.spacing);
  const ValueAxis axis{scale, chart.spacing, x0, y0, w, h};
  const auto x_of = [&](double v) { return axis.at(v); };
  const double zero = chart.spacing == Spacing::linear ? x_of(0.0) : x0;

  const std::vector<std::string> x_label = axis.label(chart.x_label, width);
  SvgCanvas canvas(width,
                   y0 + h + axis_height + label_line * static_cast<double>(x_label.size() - 1),
                   chart.title);
  canvas.text(canvas_edge, 24.0, chart.title, {.size = 15.0, .bold = true});
  axis.draw(canvas, x_label, width);
  for (std::size_t k = 0; k < chart.bars.size(); ++k) {
    const Bar& b = chart.bars[k];
    const double y = y0 + row * static_cast<double>(k) + under, middle = y + 0.5 * bar_row;
    if (above)
      canvas.text(x0, y, b.label, {.halo = true});
    else
      canvas.text(x0 - 8.0, middle + 4.0, b.label, {.anchor = "end"});
    double end = zero;  // text stands right of bar and interval
    if (const double at = x_of(b.value); std::isfinite(at)) {
      canvas.rectangle(std::min(at, zero), y + gap, std::abs(at - zero), bar_row - 2.0 * gap,
                       palette(b.colour), 0.85);
      end = std::max(end, at);
    }
    if (std::isfinite(b.low) && std::isfinite(x_of(b.high))) {
      const double low = std::isfinite(x_of(b.low)) ? x_of(b.low) : zero, high = x_of(b.high);
      canvas.line(low, middle, high, middle, "#222222", 1.3);
      for (const double x : {low, high})
        canvas.line(x, middle - 4.0, x, middle + 4.0, "#222222", 1.3);
      end = std::max(end, high);
    }
    canvas.text(end + 6.0, middle + 4.0, text_of(b), {.size = small_type, .halo = true});
  }
  canvas.line(zero, y0, zero, y0 + h, "#555555", 1.0);
  if (chart.limit) axis.draw(canvas, *chart.limit);
  return std::move(canvas).finish();
}

}  // namespace drift::report
