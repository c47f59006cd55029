#include "analysis/report/svg/value_axis.hpp"

#include <cmath>

namespace drift::report {

std::vector<std::string> ValueAxis::label(const std::string& label, double picture_width) const {
  return lines_within(scale.factor.empty() ? label : label + "  " + scale.factor,
                      picture_width - 2.0 * canvas_edge, label_type);
}

void ValueAxis::draw(SvgCanvas& canvas, const std::vector<std::string>& label,
                     double picture_width) const {
  for (std::size_t i = 0; i < scale.ticks.size(); ++i) {
    const double tick = x + scale.at(scale.ticks[i], width);
    canvas.line(tick, y, tick, y + height + 4.0, "#e4e4e4", 1.0);
    canvas.text(tick, y + height + 17.0, scale.labels[i], {.size = small_type, .anchor = "middle"});
  }
  canvas.label(x + 0.5 * width, y + height + 36.0, label, picture_width);
}

void ValueAxis::draw(SvgCanvas& canvas, const ReferenceLine& limit) const {
  const double tick = at(limit.y);
  if (!std::isfinite(tick)) return;
  canvas.line(tick, y - 4.0, tick, y + height, "#222222", 1.2, limit.stroke);
  canvas.text(tick, y - 8.0, limit.label,
              {.size = small_type, .anchor = "middle", .colour = "#222222"});
}

}  // namespace drift::report
