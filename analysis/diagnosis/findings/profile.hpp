#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace drift::diagnosis {

/// What the data and the prior lose where one parameter of a cause is held at a value and all
/// others are fitted anew through the full dynamics.
struct Profile {
  std::string label;                ///< of the cause, "magnetic_drift.y"
  int set = 0;                      ///< of the cause: alternatives have different ones
  std::string key, unit;            ///< of the parameter; values below are in `unit`
  std::size_t param = 0;            ///< index in TermLibrary
  double value = 0.0, sigma = 0.0;  ///< of the fit
  struct Point {
    double value = 0.0;
    double loss = 0.0;  ///< twice the log of the likelihood lost against the top
  };
  std::vector<Point> points = {};  ///< ascending in value
  double top = 0.0;                ///< where the loss is least
  /// Where the loss reaches that of 95 % of chi-square of one degree; NaN beyond the points.
  double low_95 = std::numeric_limits<double>::quiet_NaN();
  double high_95 = std::numeric_limits<double>::quiet_NaN();
  bool without_grid = false;  ///< settings of the cause left the library's grid: it says nothing
  bool less_mean = false;     ///< as of the parameter of the cause
};

}  // namespace drift::diagnosis
