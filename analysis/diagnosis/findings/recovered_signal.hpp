#pragma once

#include <string>
#include <vector>

#include "analysis/diagnosis/findings/shape.hpp"

namespace drift::diagnosis {

/// The missing input as a time series with its band: a platform rate or a channel error.
struct RecoveredSignal {
  std::string equation;              ///< "platform rate y"
  std::string unit;                  ///< "deg/h", "arcsec", "ug"
  std::vector<double> t;             ///< [s], interval ends
  std::vector<int> position;         ///< 1-based
  std::vector<double> value, sigma;  ///< in `unit`
  std::vector<double> explained;  ///< the winner's signature, projected alike; empty without winner
  Shape shape;
  double correlation = 0.0;  ///< of the signal with the shape

  void say_no_shape() {
    shape = {};
    correlation = 0.0;
  }
};

}  // namespace drift::diagnosis
