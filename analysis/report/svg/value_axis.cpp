#include "analysis/report/svg/value_axis.hpp"

#include <cmath>

namespace drift::report {

std::vector<std::string> ValueAxis::label(const std::string& label, double picture_width) const {
  const bool factor = spacing == Spacing::linear && !scale.factor.empty();
  return wrapped(factor ? label + "  " + scale.factor : label, picture_width - 2.0 * canvas_edge,
                 label_type);
}

void ValueAxis::draw(SvgCanvas& canvas, const std::vector<std::string>& label,
                     double picture_width) const {
  for (const std::size_t i : shown_ticks(scale, spacing)) {
    const double tick = x + scale.at(scale.ticks[i], width);
    canvas.line(tick, y, tick, y + height + 4.0, "#e4e4e4", 1.0);
    canvas.text(tick, y + height + 17.0, tick_label(scale, i, spacing),
                {.size = small_type, .anchor = "middle"});
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
