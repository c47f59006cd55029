#pragma once

#include "analysis/report/study/results.hpp"

namespace drift::report {

/// All a Monte Carlo study has to say: tables, pictures and summary.json, all its statistics with
/// numbers in the unit named beside them. InputError (config) as mc::require_own_terms().
Report study_report(const StudyResults& results);

/// What `run` prints has lines of this length.
inline constexpr std::size_t study_width = 110;

/// Points and runs whose convergence is worth showing: the first of each truth, three runs each.
std::vector<std::pair<std::size_t, std::uint64_t>> runs_to_trace(const StudyResults& results);

/// What the information in the plan promises beside what the runs found, parameter by parameter,
/// for every pair of the first points; and why they differ where they do.
Section information_section(const StudyResults& results, int threads);

}  // namespace drift::report
