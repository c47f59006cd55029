#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mc/study/study.hpp"

namespace drift::mc {

/// One combination of the values of a sweep, as a study of its own.
struct StudyPoint {
  std::string id;     ///< 16 hexadecimal digits: hash of the point's resolved text
  std::string label;  ///< "truth.coupling = eq5, plan.preset = six"; empty without a sweep
  std::vector<std::pair<std::string, std::string>> values;  ///< key and value of each axis, plain
  Study study;  ///< without sweep; its text is that of the point
};

/// Every combination of the values of [sweep], the last axis fastest; one point without a sweep.
///
/// All points have the study's seed and run numbers, so run k draws the same numbers at every point
/// (common random numbers): differences between points are not blurred by luck.
/// InputError (config) if a combination makes no study, naming it, or as require_own_terms().
std::vector<StudyPoint> study_points(const Study& study);

}  // namespace drift::mc
