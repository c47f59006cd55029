#pragma once

#include <string>

#include "analysis/planning/rank.hpp"
#include "analysis/report/page/report.hpp"
#include "analysis/report/svg/bar_chart.hpp"

namespace drift::report {

/// All a ranking has to say: tables, pictures, rank.json and ranking.csv (values in the units of
/// study files), study.toml and, with an improvement, proposed_positions.toml and improved.toml,
/// the study with these positions. `folder`: where all that is to be written; empty: nowhere.
/// InputError (config) as mc::require_own_terms().
Report rank_report(const mc::Study& study, const planning::PlanRanking& rank,
                   const std::string& folder = "");

/// Writes it. Files with positions that an earlier ranking proposed go where this one proposes
/// none. Returns names; errors as write_report().
std::vector<std::string> write_ranking(const Report& report, const std::string& folder);

/// Learning, as bits, of every parameter; eqs. (5) and (6) side by side.
BarChart learning_chart(const planning::RankingGroup& group);

/// Eigenvalues of the prior-scaled information on a log axis, one curve for each model.
Chart spectrum_chart(const planning::RankingGroup& group);

}  // namespace drift::report
