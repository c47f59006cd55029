#include "analysis/report/svg/heat_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "analysis/report/svg/svg_canvas.hpp"
#include "core/base/check.hpp"
#include "core/base/number_text.hpp"

namespace drift::report {
namespace {

constexpr double key_width = 168.0, key_gap = 12.0;   // [px]
constexpr double least_cell = 4.0, most_cell = 70.0;  // [px]

/// From white to the blue or orange of the palette; x in -1..1.
std::string colour_of(double x) {
  if (!std::isfinite(x)) return "#dddddd";
  const double a = std::clamp(std::abs(x), 0.0, 1.0);
  const std::string_view full = palette(x >= 0.0 ? blue : orange);
  const auto mix = [&](std::size_t begin) {  // of "#0072B2" the two digits that begin there
    int c = 0;
    std::from_chars(full.data() + begin, full.data() + begin + 2, c, 16);
    return static_cast<int>(std::lround(255.0 + a * (c - 255.0)));
  };
  return fmt::format("#{:02X}{:02X}{:02X}", mix(1), mix(3), mix(5));
}

void key(SvgCanvas& canvas, const HeatMap& map, double x, double y, double most, bool negative) {
  constexpr int steps = 21;
  constexpr double step = key_width / steps;
  const double low = negative ? -1.0 : 0.0;
  for (int k = 0; k < steps; ++k)
    canvas.rectangle(x + step * k, y, step + 0.2, 10.0,
                     colour_of(low + (1.0 - low) * k / (steps - 1.0)));
  const double end = x + step * steps;
  canvas.text(x, y + 24.0, number_text(low * most, 2), {.size = small_type});
  canvas.text(end, y + 24.0, number_text(most, 2), {.size = small_type, .anchor = "end"});
  canvas.text(end + key_gap, y + 9.0, map.value_label);
}

}  // namespace

std::string svg_of(const HeatMap& map) {
  const auto rows = map.value.rows(), columns = map.value.cols();
  DRIFT_DEMAND(rows == static_cast<Eigen::Index>(map.rows.size()));
  DRIFT_DEMAND(columns == static_cast<Eigen::Index>(map.columns.size()));
  const double row_height = map.row_height;
  double label = 30.0, most = map.most;
  bool negative = false;
  for (const auto& r : map.rows) label = std::max(label, text_pixels(r, label_type));
  double column_label = 10.0;
  for (const auto& c : map.columns)
    column_label = std::max(column_label, text_pixels(c, small_type));
  for (const double v : map.value.reshaped()) {
    if (!std::isfinite(v)) continue;
    if (map.most <= 0.0) most = std::max(most, std::abs(v));
    negative = negative || v < 0.0;
  }
  if (!(most > 0.0)) most = 1.0;
  double number = 0.0;  // the widest
  for (const double v : map.value.reshaped())
    if (std::isfinite(v)) number = std::max(number, text_pixels(number_text(v, 2), small_type));
  label = std::min(label, 0.45 * map.width) + (map.y_label.empty() ? 0.0 : 18.0);
  const double x0 = canvas_edge + label + 8.0;
  const double cell =
      std::clamp((map.width - x0 - canvas_edge) / std::max(static_cast<double>(columns), 1.0),
                 least_cell, most_cell);
  const double width = std::max({map.width, x0 + cell * static_cast<double>(columns) + canvas_edge,
                                 text_pixels(map.title, 15.0) + 2.0 * canvas_edge});
  const double y0 = map.title.empty() ? 10.0 : 42.0;
  const double bottom = y0 + row_height * static_cast<double>(rows);
  const bool turned = column_label > cell - 4.0;
  const double under =
      (turned ? std::min(column_label, 160.0) + 10.0 : 18.0) + (map.x_label.empty() ? 0.0 : 20.0);

  SvgCanvas canvas(width, bottom + under + 44.0, map.title);
  canvas.text(canvas_edge, 24.0, map.title, {.size = 15.0, .bold = true});
  if (!map.y_label.empty())
    canvas.text(canvas_edge + 8.0, 0.5 * (y0 + bottom), map.y_label,
                {.anchor = "middle", .turned = -90.0});
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double y = y0 + row_height * static_cast<double>(i);
    canvas.text(x0 - 8.0, y + 0.5 * row_height + 4.0, map.rows[static_cast<std::size_t>(i)],
                {.anchor = "end"});
    for (Eigen::Index j = 0; j < columns; ++j) {
      const double v = map.value(i, j), x = x0 + cell * static_cast<double>(j);
      canvas.rectangle(x + 0.5, y + 0.5, cell - 1.0, row_height - 1.0, colour_of(v / most));
      if (cell >= number + 4.0 && std::isfinite(v))
        canvas.text(x + 0.5 * cell, y + 0.5 * row_height + 4.0, number_text(v, 2),
                    {.size = small_type,
                     .anchor = "middle",
                     .colour = std::abs(v) > 0.6 * most ? "#ffffff" : "#333333"});
    }
  }
  const std::size_t every = turned ? static_cast<std::size_t>(std::ceil(12.0 / cell)) : 1;
  for (std::size_t j = 0; j < map.columns.size(); j += every) {
    const double x = x0 + cell * (static_cast<double>(j) + 0.5);
    if (turned)
      canvas.text(x + 4.0, bottom + 8.0, map.columns[j],
                  {.size = small_type, .anchor = "end", .turned = -90.0});
    else
      canvas.text(x, bottom + 15.0, map.columns[j], {.size = small_type, .anchor = "middle"});
  }
  if (!map.x_label.empty())
    canvas.text(x0 + 0.5 * cell * static_cast<double>(columns), bottom + under - 4.0, map.x_label,
                {.anchor = "middle"});
  // Under the cells, and farther left where what the colours mean would not fit beside it.
  const double room = width - canvas_edge - text_pixels(map.value_label, label_type);
  const double key_x = std::clamp(room - key_width - key_gap, canvas_edge, x0);
  key(canvas, map, key_x, bottom + under + 8.0, most, negative);
  return std::move(canvas).finish();
}

}  // namespace drift::report
