#include "analysis/report/svg/dumbbell_chart.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/report/svg/value_axis.hpp"

namespace drift::report {
namespace {

constexpr double line_height = 19.0, label_height = 16.0, room_of_axis = 44.0;  // [px]
constexpr std::size_t before_colour = orange, after_colour = blue;

void mark(SvgCanvas& canvas, double x, double y, std::string_view colour) {
  if (std::isfinite(x)) canvas.rectangle(x - 4.0, y - 4.0, 8.0, 8.0, colour);
}

}  // namespace

std::string svg_of(const DumbbellChart& chart) {
  double label_width = 40.0, text_width = text_pixels(chart.text_label, small_type);
  Range range;
  for (const Dumbbell& d : chart.lines) {
    label_width = std::max(label_width, text_pixels(d.label, label_type));
    text_width = std::max(text_width, text_pixels(d.text, small_type));
    for (const double v : {d.before, d.after, d.low, d.high})
      range.include(spaced(v, chart.spacing));
  }
  if (chart.limit) range.include(spaced(chart.limit->y, chart.spacing));
  const double width = std::max(chart.width, text_pixels(chart.title, 15.0) + 2.0 * canvas_edge);
  const double room = width - text_width - canvas_edge - 14.0;
  const bool above = room - (canvas_edge + label_width + 10.0) < least_plot;  // labels above lines
  const double x0 = canvas_edge + (above ? 0.0 : label_width) + 10.0, w = room - x0;
  const double under = above ? label_height : 0.0, row = line_height + under;
  const double keys = 44.0 + text_pixels(chart.before_label, label_type) +
                      text_pixels(chart.after_label, label_type),
               key_x = std::max(std::min(x0, width - canvas_edge - keys), canvas_edge);
  const bool crossed = key_x + keys > width - canvas_edge - text_width - 8.0;  // key and text_label
  const double y0 = (chart.title.empty() ? 30.0 : 58.0) + (chart.limit ? 14.0 : 0.0) +
                    (crossed && !chart.text_label.empty() ? label_line : 0.0);
  const double h = row * static_cast<double>(chart.lines.size());
  const AxisScale scale = make_scale(range, static_cast<int>(w / 60.0), 0.03, chart.spacing);
  const ValueAxis axis{scale, chart.spacing, x0, y0, w, h};
  const auto x_of = [&](double v) { return axis.at(v); };

  const std::vector<std::string> x_label = axis.label(chart.x_label, width);
  SvgCanvas canvas(width,
                   y0 + h + room_of_axis + label_line * static_cast<double>(x_label.size() - 1),
                   chart.title);
  canvas.text(canvas_edge, 24.0, chart.title, {.size = 15.0, .bold = true});
  const double key = chart.title.empty() ? 16.0 : 44.0;
  mark(canvas, key_x + 4.0, key - 4.0, palette(before_colour));
  canvas.text(key_x + 14.0, key, chart.before_label);
  const double second = key_x + 34.0 + text_pixels(chart.before_label, label_type);
  mark(canvas, second, key - 4.0, palette(after_colour));
  canvas.text(second + 10.0, key, chart.after_label);
  canvas.text(width - canvas_edge, y0 - 8.0, chart.text_label,
              {.size = small_type, .anchor = "end"});
  axis.draw(canvas, x_label, width);
  for (std::size_t k = 0; k < chart.lines.size(); ++k) {
    const Dumbbell& d = chart.lines[k];
    const double y = y0 + row * static_cast<double>(k) + under + 0.5 * line_height;
    if (above)
      canvas.text(x0, y - 0.5 * line_height, d.label, {.halo = true});
    else
      canvas.text(x0 - 10.0, y + 4.0, d.label, {.anchor = "end"});
    const double from = x_of(d.before), to = x_of(d.after);
    if (std::isfinite(from) && std::isfinite(to)) canvas.line(from, y, to, y, "#999999", 1.6);
    if (std::isfinite(d.low) && std::isfinite(d.high))
      canvas.line(x_of(d.low), y, x_of(d.high), y, palette(after_colour), 3.0);
    mark(canvas, from, y, palette(before_colour));
    mark(canvas, to, y, palette(after_colour));
    canvas.text(width - canvas_edge, y + 4.0, d.text, {.size = small_type, .anchor = "end"});
  }
  if (chart.limit) axis.draw(canvas, *chart.limit);
  return std::move(canvas).finish();
}

}  // namespace drift::report
