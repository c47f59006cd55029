#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/observability/drivers.hpp"
#include "analysis/observability/information_by_position.hpp"
#include "analysis/observability/other_methods.hpp"
#include "analysis/planning/improve.hpp"
#include "mc/study/study.hpp"

namespace drift::planning {

/// Learning ratios of a parameter at other points than the one the plan is linearised at: at four
/// truths drawn from [truth], without one from the priors.
struct Elsewhere {
  static constexpr double factor = 1.5;  ///< between ratios: worth a line
  double low = 0.0, high = 0.0;
  bool drawn() const { return high > 0.0; }  ///< not where [truth] fixes every parameter
  bool other_than(double here) const {
    return drawn() && (high >= factor * here || low <= here / factor);
  }
};

/// The ranking of a plan under one model, by every method.
struct ModelRanking {
  observability::RankedModel model;
  std::string filters;  ///< names in the file, "corrected, legacy"; empty: the other of eqs. (5)
                        ///< and (6), put beside a filter
  bool of_the_file() const { return !filters.empty(); }
  observability::Ranking ranking;
  std::vector<observability::TimeBin> bins;  ///< without their rows
  observability::InformationCourse course;
  observability::PwcsRank pwcs;
  std::vector<observability::MethodRanking> methods;
  observability::Drivers drivers;
  std::vector<Elsewhere> elsewhere;  ///< of each state
};

/// Models of the same terms and priors, side by side: eqs. (5) and (6) for a filter of either.
struct RankingGroup {
  std::string filters;  ///< names in the file, of all
  /// A filter of the file, and the equation of its own.
  struct Named {
    std::string name;
    Coupling coupling = Coupling::eq5;
  };
  std::vector<Named> each;           ///< in the order of the file
  std::vector<ModelRanking> models;  ///< that of the first filter first

  const Layout& layout() const { return models.front().ranking.layout; }
};

/// A better plan for the first filter: the first model of the first group.
struct PlanImprovement {
  Improvement improvement;
  observability::Ranking after;      ///< of the improved plan
  std::vector<Elsewhere> elsewhere;  ///< of its states, at the truths of ModelRanking::elsewhere
};

/// Everything `driftscope rank` says.
struct PlanRanking {
  double duration = 0.0;       ///< of the plan, slews included [s]
  bool at_truth = false;       ///< linearised at the means of [truth], else at prior means
  bool process_noise = false;  ///< a filter has it: it is in what is said of that one
  /// The magnetic field that is taken, local axes [T]; nothing if one is declared, or none needed.
  std::optional<Vec3> assumed_field_l;
  std::vector<RankingGroup> groups;
  std::optional<PlanImprovement> better;
};

/// What to look for beside the ranking.
struct RankOptions {
  std::size_t improve = 0;      ///< positions to add
  std::string criterion = "A";  ///< A, D or a parameter
  int threads = 0;              ///< 0: all
  int bins_per_dwell = 6;
  std::optional<Improvement> improvement = {};  ///< found by improve_study() before
};

/// What a better plan of the study should make small, by its name. InputError as rank_plan().
Criterion criterion_of(const mc::Study& study, const std::string& name);

/// A better plan for the first filter, as rank_plan() finds it, judged by `judge`; nothing if that
/// ended before. InputError as rank_plan().
std::optional<Improvement> improve_study(const mc::Study& study, const RankOptions& options,
                                         const JudgeStep& judge,
                                         const ImproveProgress& progress = {});

/// Ranks every filter of a study on its plan; no sampling. A magnetic field that nobody declares is
/// that of a dipole. InputError (config) for a strapdown study or one without filter, or where a
/// filter follows what a recording alone has, or as mc::require_own_terms(); (usage) for an unknown
/// criterion.
PlanRanking rank_plan(const mc::Study& study, const RankOptions& options,
                      const ImproveProgress& progress = {});

}  // namespace drift::planning
