#pragma once

#include <string>
#include <vector>

#include "analysis/planning/rank.hpp"
#include "analysis/report/page/html_report.hpp"

namespace drift::report {

/// The ranking for a terminal.
std::string to_text(const mc::Study& study, const planning::PlanRanking& rank);

/// rank.json; NaN and infinity are null. Values are in the units of study files.
std::string to_json(const mc::Study& study, const planning::PlanRanking& rank);

/// The page with all tables and pictures.
HtmlReport rank_html(const mc::Study& study, const planning::PlanRanking& rank);

/// Learning, as bits, of every parameter; eqs. (5) and (6) side by side.
std::string learning_figure(const planning::RankingGroup& group);
/// Eigenvalues of the prior-scaled information on a log axis, one curve for each model.
std::string spectrum_figure(const planning::RankingGroup& group);
/// Information by position and parameter.
std::string position_figure(const mc::Study& study, const planning::ModelRanking& model);
/// Information by time and parameter.
std::string time_figure(const planning::ModelRanking& model);
/// Bits that the proposed positions add to each parameter.
std::string improvement_figure(const planning::PlanRanking& rank);

/// Writes rank.json, report.html, the pictures, study.toml and, with an improvement,
/// proposed_positions.toml into a folder, made if need be. Returns the names of the files.
/// InputError (io) if one cannot be written.
std::vector<std::string> write_results(const mc::Study& study, const planning::PlanRanking& rank,
                                       const std::string& folder);

}  // namespace drift::report
