#pragma once

#include <string>
#include <vector>

#include "core/base/linalg.hpp"

namespace drift::report {

/// Numbers in a grid as colours: blue above zero, orange below, white at zero, hatched grey where
/// there is no number.
struct HeatMap {
  std::string title;
  std::string x_label, y_label;
  std::string value_label;  ///< what the colours mean, with unit
  std::vector<std::string> rows, columns;
  MatX value;                ///< shape (rows, columns); NaN: nothing known
  double most = 0.0;         ///< at which colours end; 0: the largest magnitude in `value`
  double width = 860.0;      ///< [px], more if the cells need it
  double row_height = 24.0;  ///< [px]
};

/// The map as an SVG document, the numbers in the cells where there is room for them.
std::string svg_of(const HeatMap& map);

}  // namespace drift::report
