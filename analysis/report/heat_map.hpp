#pragma once

#include <string>
#include <vector>

#include "core/base/linalg.hpp"

namespace drift {

/// Values over rows and columns as shades of one colour, white at zero and below.
struct HeatMap {
  std::string title;
  std::string scale_label;           ///< what a shade means, with its unit
  std::vector<std::string> rows;     ///< labels, from top to bottom
  std::vector<std::string> columns;  ///< labels, from left to right
  MatX values;                       ///< shape (rows, columns); NaN is hatched grey
  double cell_width = 0.0;           ///< [px]; 0: as fits in a page
};

/// The map as an SVG document, a scale beside it. Values are written into the cells where they fit.
std::string svg_of(const HeatMap& map);

}  // namespace drift
