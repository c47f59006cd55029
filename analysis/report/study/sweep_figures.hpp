#pragma once

#include "analysis/report/study/results.hpp"

namespace drift::report {

/// Statistics against the swept value, one picture for each axis whose values are numbers.
std::vector<Picture> sweep_pictures(const StudyResults& results);

}  // namespace drift::report
