#pragma once

#include <string>

#include "analysis/report/study/results.hpp"

namespace drift::report {

/// The report of a study, with its pictures.
HtmlReport study_html(const StudyResults& results);

/// What `run` prints: headlines and the crossed table.
std::string study_text(const StudyResults& results);

/// Points and runs whose convergence is worth showing: the first of each truth, three runs each.
std::vector<std::pair<std::size_t, std::uint64_t>> runs_to_trace(const StudyResults& results);

/// Writes report.html and summary.json into a folder, made if need be. Returns the names.
/// InputError (io) if one cannot be written.
std::vector<std::string> write_study_report(const StudyResults& results, const std::string& folder);

}  // namespace drift::report
