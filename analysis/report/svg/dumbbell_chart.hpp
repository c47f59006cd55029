#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "analysis/report/svg/svg_chart.hpp"

namespace drift::report {

/// A value before and after, joined by an arrow; the interval around `after` where it is finite.
struct Dumbbell {
  std::string label;
  double before = 0.0, after = 0.0;
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();
  std::string text = {};  ///< at the right edge
};

struct DumbbellChart {
  std::string title;
  std::string x_label;  ///< with its unit
  std::string before_label = "before", after_label = "after";
  std::string text_label = {};  ///< heads the texts at the right edge
  std::vector<Dumbbell> lines;
  Spacing spacing = Spacing::linear;   ///< logarithmic: values that are not positive are not shown
  std::optional<ReferenceLine> limit;  ///< a vertical line at a value (its member y)
  double width = 860.0;                ///< [px]
};

/// The lines from top to bottom as an SVG document.
std::string svg_of(const DumbbellChart& chart);

}  // namespace drift::report
