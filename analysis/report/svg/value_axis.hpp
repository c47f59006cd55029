#pragma once

#include <string>
#include <vector>

#include "analysis/report/svg/svg_canvas.hpp"
#include "analysis/report/svg/svg_chart.hpp"

namespace drift::report {

/// The horizontal axis of a chart of labelled rows: values along `width` from x, under rows that
/// begin at y and are `height` high [px].
struct ValueAxis {
  const AxisScale& scale;
  Spacing spacing;
  double x, y, width, height;

  double at(double value) const { return x + scale.at(spaced(value, spacing), width); }
  /// `label` with the factor of its numbers, in lines no wider than the picture.
  std::vector<std::string> label(const std::string& label, double picture_width) const;
  /// Its lines, their numbers and the label.
  void draw(SvgCanvas& canvas, const std::vector<std::string>& label, double picture_width) const;
  /// A vertical line at a value (its member y), where it can be shown.
  void draw(SvgCanvas& canvas, const ReferenceLine& limit) const;
};

}  // namespace drift::report
