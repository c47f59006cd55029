#include "analysis/report/heat_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/report/axis_scale.hpp"
#include "analysis/report/number_text.hpp"
#include "analysis/report/svg_canvas.hpp"

namespace drift {
namespace {

constexpr double row = 16.0, edge = 14.0, page = 900.0, scale_width = 96.0;  // [px]
constexpr std::string_view shade = "#0072B2", missing = "#dddddd";

}  // namespace

std::string svg_of(const HeatMap& map) {
  const auto rows = static_cast<Eigen::Index>(map.rows.size());
  const auto columns = static_cast<Eigen::Index>(map.columns.size());
  double row_label = 20.0, column_label = 20.0, most = 0.0;
  for (const auto& label : map.rows) row_label = std::max(row_label, text_pixels(label, 10.5));
  for (const auto& label : map.columns) column_label = std::max(column_label, text_pixels(label, 10.5));
  for (const double v : map.values.reshaped())
    if (std::isfinite(v)) most = std::max(most, v);

  const double x0 = edge + row_label + 8.0;
  const double room = page - x0 - scale_width - edge;
  const double cell = map.cell_width > 0.0
                          ? map.cell_width
                          : std::clamp(room / std::max<double>(1.0, static_cast<double>(columns)), 6.0, 44.0);
  // Labels are turned where they are wider than their column.
  const bool turned = column_label > cell - 4.0;
  const double y0 = 40.0 + (turned ? 0.8 * std::min(column_label, 160.0) + 14.0 : 20.0);
  const double w = cell * static_cast<double>(columns), h = row * static_cast<double>(rows);
  SvgCanvas canvas(x0 + w + scale_width + edge, y0 + std::max(h, 120.0) + edge, map.title);
  canvas.text(edge, 24.0, map.title, {.size = 15.0, .bold = true});
  for (Eigen::Index c = 0; c < columns; ++c) {
    const double x = x0 + cell * (static_cast<double>(c) + 0.5);
    const bool shown = cell >= 9.0 || c % 2 == 0;
    if (shown && turned)
      canvas.text(x, y0 - 6.0, map.columns[c], {.size = 10.5, .turned = -52.0});
    else if (shown)
      canvas.text(x, y0 - 6.0, map.columns[c], {.size = 10.5, .anchor = "middle"});
  }
  for (Eigen::Index r = 0; r < rows; ++r) {
    const double y = y0 + row * static_cast<double>(r);
    canvas.text(x0 - 8.0, y + 0.75 * row, map.rows[r], {.size = 10.5, .anchor = "end"});
    for (Eigen::Index c = 0; c < columns; ++c) {
      const double v = map.values(r, c), x = x0 + cell * static_cast<double>(c);
      if (!std::isfinite(v)) {
        canvas.rectangle(x, y, cell - 1.0, row - 1.0, missing);
        continue;
      }
      const double part = most > 0.0 ? std::max(0.0, v) / most : 0.0;
      canvas.rectangle(x, y, cell - 1.0, row - 1.0, "#f4f4f4");
      canvas.rectangle(x, y, cell - 1.0, row - 1.0, shade, part);
      const std::string text = decimal_text(v, 1);
      if (cell >= 26.0 && v >= 0.05)
        canvas.text(x + 0.5 * cell, y + 0.72 * row, text,
                    {.size = 9.5, .anchor = "middle", .colour = part > 0.55 ? "#ffffff" : "#333333"});
    }
  }
  const double x = x0 + w + 20.0;
  constexpr int steps = 20;
  for (int k = 0; k < steps; ++k)
    canvas.rectangle(x, y0 + 100.0 * k / steps, 14.0, 100.0 / steps, shade, 1.0 - (k + 0.5) / steps);
  canvas.text(x + 20.0, y0 + 8.0, number_text(most), {.size = 10.5});
  canvas.text(x + 20.0, y0 + 102.0, "0", {.size = 10.5});
  canvas.text(x, y0 + 118.0, map.scale_label, {.size = 10.5});
  return std::move(canvas).finish();
}

}  // namespace drift
