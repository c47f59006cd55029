#pragma once

#include "analysis/report/study/results.hpp"

namespace drift::report {

/// What must not be missed, in words: for each truth and filter how often it fails, how often
/// silently, and where most. Refused, with the reason, where more than 1 % of the runs are lost.
std::vector<std::string> study_headlines(const StudyResults& results);

/// Truth x filter: consistency, health, silent failures, the worst parameter.
Table crossed_table(const StudyResults& results);

/// Every parameter of a pair: bias, RMSE, sigma, deception, coverage, silent failures, starts.
Table parameter_table(const StudyResults& results, const Pair& pair);

/// Starts of every pair beside each other.
Table start_table(const StudyResults& results);

/// Lost and diverged runs, and whether they have to do with a parameter; without rows if all went
/// well.
Table failure_table(const StudyResults& results);

}  // namespace drift::report
