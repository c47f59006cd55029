#pragma once

#include "analysis/report/study/results.hpp"

namespace drift::report {

/// Silent failure rate of every truth and filter, with intervals.
Picture silent_failure_picture(const StudyResults& results);

/// Monte Carlo ranking of a pair: RMSE over prior sigma of every parameter with bootstrap
/// intervals, best known first.
Picture ranking_picture(const StudyResults& results, const Pair& pair);

/// Error against reported sigma of the first runs, for the parameters a truth and its filters are
/// worst at; outside the lines at 5 sigma the filter is sure and wrong.
Picture scatter_picture(const StudyResults& results, std::size_t point);

/// Errors of the traced runs of a point against time, with the filter's 1 sigma band.
Picture convergence_picture(const StudyResults& results, std::size_t point);

/// Parameters worth a picture at a point: the worst of each filter, then misalignments.
std::vector<std::size_t> pictured_parameters(const StudyResults& results, std::size_t point);

}  // namespace drift::report
