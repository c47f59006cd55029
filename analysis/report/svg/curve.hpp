#pragma once

#include "analysis/report/svg/svg_chart.hpp"

namespace drift::report {

/// A curve without points yet.
inline Series curve(std::string_view label, std::size_t colour, Stroke stroke = Stroke::solid) {
  Series s;
  s.label = label;
  s.colour = colour;
  s.stroke = stroke;
  return s;
}

}  // namespace drift::report
