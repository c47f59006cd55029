#pragma once

#include <string>
#include <vector>

#include "core/base/units.hpp"
#include "mc/study/sweep.hpp"

namespace drift::mc {

/// What the values of one swept key are at the points: numbers with a unit where all are, else
/// words.
struct SweptCoordinate {
  std::string key;
  std::vector<std::string> words;  ///< of each point
  std::vector<double> numbers;     ///< in `unit`; empty where a value is no number
  Unit unit = unit::one;

  /// "truth.parameters.eta_x [arcsec]"; of words and bare numbers the key alone.
  std::string title() const;
};

/// Of every swept key, in the order of the study, each of those that are swept together by itself
/// (`readout = [{ gimbal_noise = "1 arcsec", ... }]`: readout.gimbal_noise); none without a sweep
/// or points.
std::vector<SweptCoordinate> swept_coordinates(const std::vector<StudyPoint>& points);

}  // namespace drift::mc
