#pragma once

#include <string>

#include "analysis/report/study/results.hpp"

namespace drift::report {

/// All statistics of a study as JSON ("summary.json"), numbers in the unit named beside them; what
/// is not a number is null.
std::string study_json(const StudyResults& results);

}  // namespace drift::report
