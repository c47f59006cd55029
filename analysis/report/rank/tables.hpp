#pragma once

#include <string>
#include <vector>

#include "analysis/planning/rank.hpp"
#include "analysis/report/page/degeneracies.hpp"
#include "analysis/report/page/table.hpp"

namespace drift::report {

/// "eq5 (filter corrected)", "eq6 (beside filter corrected)".
std::string label_of(const planning::RankingGroup& group, const planning::ModelRanking& model);

/// What a reader must not miss, one sentence each.
std::vector<std::string> headlines(const mc::Study& study, const planning::PlanRanking& rank);

/// "6 positions in 6.00 h; linearised at the means of [truth]; noise 5 ug, 5 arcsec".
std::string plan_line(const mc::Study& study, const planning::PlanRanking& rank);

/// Every parameter by rising learning ratio of the first model; the second model beside it.
Table ranking_table(const planning::RankingGroup& group);

/// Parameters of which eqs. (5) and (6) promise sigmas more than a factor 1.5 apart.
Table coupling_table(const planning::RankingGroup& group);

/// Parameters whose sigma depends on where the truth lies.
Table elsewhere_table(const planning::ModelRanking& model);

/// What each position tells, and what is lost without it.
Table position_table(const mc::Study& study, const planning::ModelRanking& model);

/// For each parameter the position and the minutes that tell most of it.
Table minutes_table(const mc::Study& study, const planning::ModelRanking& model);

/// The best and the worst seen directions.
Table direction_table(const planning::ModelRanking& model);

/// Directions of which the data say nothing, and those that the attitude prior alone holds.
Table null_table(const planning::ModelRanking& model);

/// Rank correlation of the other methods with the learning ratio.
Table method_table(const planning::ModelRanking& model);

/// Where two rankings disagree and why, one sentence each.
std::vector<std::string> disagreements(const planning::ModelRanking& model);

/// Positions proposed, with the criterion before and after.
Table improvement_table(const planning::PlanRanking& rank);

/// Expected sigma of every parameter before and after, largest gain first.
Table gain_table(const planning::PlanRanking& rank);

/// The proposed positions as TOML: those to append, or, where the plan is a preset, all of them.
std::string proposed_toml(const mc::Study& study, const planning::PlanRanking& rank);

/// Exact degeneracies of a model by name.
std::vector<NamedDirection> exact_degeneracies(const planning::ModelRanking& model);

/// Directions that only the prior of the attitude at the cagings holds, by name.
std::vector<NamedDirection> held_by_attitude(const planning::ModelRanking& model);

}  // namespace drift::report
