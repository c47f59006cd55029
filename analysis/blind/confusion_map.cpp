#include "analysis/blind/confusion_map.hpp"

#include <algorithm>
#include <numeric>

#include "analysis/report/svg_canvas.hpp"

namespace drift::blind {

std::string svg_of(const Confusion& c) {
  constexpr double cell = 22.0, edge = 14.0, text = 10.5;
  double left = 60.0, top = 60.0;
  for (const ConfusionRow& r : c.rows) left = std::max(left, text_pixels(r.hidden, text));
  for (const std::string& name : c.columns) top = std::max(top, text_pixels(name, text));
  const double x0 = edge + left + 8.0, y0 = 40.0 + top + 8.0;
  const double width = x0 + cell * static_cast<double>(c.columns.size()) + edge + 30.0;
  SvgCanvas canvas(std::max(width, 360.0), y0 + cell * static_cast<double>(c.rows.size()) + edge, "Confusion");
  canvas.text(edge, 24.0, "What was hidden (rows) and what it was called (columns)", {.size = 15.0, .bold = true});
  for (std::size_t k = 0; k < c.columns.size(); ++k) {
    const double x = x0 + cell * (static_cast<double>(k) + 0.65);
    canvas.text(x, y0 - 8.0, c.columns[k], {.size = text, .turned = -90.0});
  }
  for (std::size_t r = 0; r < c.rows.size(); ++r) {
    const ConfusionRow& row = c.rows[r];
    const double y = y0 + cell * static_cast<double>(r);
    canvas.text(x0 - 8.0, y + 0.65 * cell, row.hidden, {.size = text, .anchor = "end"});
    const auto total = std::accumulate(row.called.begin(), row.called.end(), std::size_t{0});
    for (std::size_t k = 0; k < row.called.size(); ++k) {
      const double x = x0 + cell * static_cast<double>(k);
      canvas.rectangle(x + 0.5, y + 0.5, cell - 1.0, cell - 1.0, "#f2f2f2");
      if (row.called[k] == 0) continue;
      const double share = static_cast<double>(row.called[k]) / static_cast<double>(total);
      const bool right = row.hidden == c.columns[k];
      canvas.rectangle(x + 0.5, y + 0.5, cell - 1.0, cell - 1.0, palette(right ? 2 : 0), 0.15 + 0.85 * share);
      canvas.text(x + 0.5 * cell, y + 0.65 * cell, std::to_string(row.called[k]),
                  {.size = text, .anchor = "middle", .colour = share > 0.5 ? "#ffffff" : "#222222"});
    }
  }
  return std::move(canvas).finish();
}

}  // namespace drift::blind
