#pragma once

#include "analysis/report/page/degeneracies.hpp"
#include "analysis/report/page/json.hpp"
#include "analysis/report/page/wording.hpp"
#include "analysis/report/rank/report.hpp"

namespace drift::report {

/// A filter's models, in the ranking of a plan.
struct RankedGroup {
  const mc::Study& study;
  const planning::RankingGroup& group;
  std::string suffix;  ///< of the names of its pictures, "_2"; empty of a group that is alone
};

/// What is said of each group, in this order.
DRIFT_SECTIONS(RankedGroup, group_sections, (learning, evidence), (equations, how_sure),
               (elsewhere, how_sure), (unseen, how_sure), (drivers, details), (directions, details),
               (course, details), (methods, details));

/// The positions proposed and what they bring; nothing where none were asked for.
Section improvement(const mc::Study& study, const planning::PlanRanking& rank);

/// Where truths are drawn from, other than the point of the ranking.
inline std::string_view source_of_truths(bool at_truth) {
  return at_truth ? "[truth]" : "the priors";
}

/// Of several models a terminal shows the first.
inline On shown_of(std::size_t model) {
  return model == 0 ? On::both : On::page;
}

/// The study with the proposed positions in its plan: a file beside the report.
inline constexpr const char* improved_study = "improved.toml";

/// Whether positions were proposed that do anything to the parameter that was asked for, of a
/// criterion over all to any: then improved_study is written.
bool has_better_plan(const planning::PlanRanking& rank);

/// What the plan sees and what not, in words; and what the proposed positions bring. `folder`: of
/// the files; empty where none are written.
InBrief rank_in_brief(const mc::Study& study, const planning::PlanRanking& rank,
                      const std::string& folder = "");

/// What a reader must not miss, one sentence each.
std::vector<std::string> headlines(const mc::Study& study, const planning::PlanRanking& rank);

/// Parameters that walk, "D_F_x": what is said of them is of the last sample.
std::vector<std::string> of_the_last_sample(const planning::ModelRanking& model);
/// That they are, of every filter of the file: "A drift that walks is that of ...: D_F_x of f.";
/// empty where nothing walks.
std::string walk_text(const planning::PlanRanking& rank);

/// That a field had to be assumed, where it had: the remark that a diagnosis makes of it.
std::string field_remark(const planning::PlanRanking& rank);

// What stands in rank.json too.

/// Every parameter by rising learning ratio of the first model; a second model beside it.
Table ranking_table(const planning::ModelRanking& model, const planning::ModelRanking* other);
/// How much smaller every sigma becomes where noise or a prior is halved, in percent.
Table driver_table(const planning::ModelRanking& model);
/// What each position tells, and what is lost without it.
Table position_table(const mc::Study& study, const planning::ModelRanking& model);
/// Positions proposed, with the criterion before and after.
/// The equation that the proposed positions were chosen for.
std::string_view equation_of_plan(const planning::PlanRanking& rank);
Table improvement_table(const planning::PlanRanking& rank);
/// The proposed positions as TOML, to be pasted into the user's own file: those to append, or,
/// where the plan is a preset, all that take its place.
std::string proposed_toml(const mc::Study& study, const planning::PlanRanking& rank);
/// Directions that the data do not see, and those that the attitude prior alone holds.
std::vector<NamedDirection> unseen_directions(const planning::ModelRanking& model);
std::vector<NamedDirection> held_by_attitude(const planning::ModelRanking& model);

Json rank_document(const mc::Study& study, const planning::PlanRanking& rank);

/// ranking.csv: the rows of ranking_table() of every filter and model, in the units of study files,
/// with all their digits.
std::string ranking_csv(const planning::PlanRanking& rank);

}  // namespace drift::report
