#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "analysis/report/svg/svg_chart.hpp"

namespace drift::report {

/// One horizontal bar from zero (on a logarithmic axis from its edge) to a value, with an interval
/// where its ends are finite.
struct Bar {
  std::string label;
  double value = 0.0;
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();
  std::size_t colour = 0;  ///< index in the palette
  std::string text = {};   ///< beside the bar; empty: the value
};

struct BarChart {
  std::string title;
  std::string x_label;  ///< with its unit
  std::vector<Bar> bars;
  std::optional<ReferenceLine> limit;  ///< a vertical line at a value (its member y)
  double width = 720.0;                ///< [px]
  Spacing spacing = Spacing::linear;   ///< logarithmic: values that are not positive have no bar
};

/// The bars from top to bottom as an SVG document; a value that is not finite is "n/a".
std::string svg_of(const BarChart& chart);

}  // namespace drift::report
