#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/observability/information.hpp"

namespace drift::planning {

/// What a better plan should make small.
struct Criterion {
  enum class Kind {
    A,          ///< trace of the prior-scaled posterior covariance: sum of squared learning ratios
    D,          ///< log2 of its determinant, over 2: minus the bits gained
    parameter,  ///< learning ratio of one parameter
  };
  Kind kind = Kind::A;
  std::size_t state = 0;  ///< of Kind::parameter
  std::string text = "A";
};

/// Reads "A", "D" or a parameter key. InputError (usage) if it is none, or no state of the layout.
Criterion parse_criterion(const std::string& text, const Layout& layout);

/// One position added.
struct ImprovementStep {
  Position position;
  double duration = 0.0;             ///< slew and dwell [s]
  double before = 0.0, after = 0.0;  ///< criterion
  std::size_t feasible = 0;          ///< candidates that gimbals allowed
  VecX learning_ratios;              ///< after this step, layout order
};

/// A plan with positions added.
struct Improvement {
  Criterion criterion;
  VecX before;  ///< learning ratios of the plan as it is
  std::vector<ImprovementStep> steps;
  TestPlan plan;  ///< the old positions, then the new ones

  double added() const;  ///< time [s]
};

/// Called as steps are completed: done, total.
using ImproveProgress = std::function<void(std::size_t, std::size_t)>;

/// What the candidates of one step are worth, in their order: the greatest is taken, of equals the
/// first. Nothing: the gimbals do not allow it.
using Merits = std::vector<std::optional<double>>;
using Judge = std::function<std::optional<double>(std::size_t candidate)>;

/// Has all candidates of a step judged; nothing if that ended before. The judge may be called for
/// different candidates at the same time.
using JudgeStep = std::function<std::optional<Merits>(std::size_t step, std::size_t candidates,
                                                      const Judge& judge)>;

/// Judges on this process's threads.
JudgeStep judge_here(int threads);

/// Adds `count` positions, greedily: each time the candidate that makes the criterion smallest (the
/// first of equals). Candidates are all attitudes under both command laws, caged; where the plan
/// slews, also slewed to, with the case left where the gimbals allow it, and with it turned half
/// or once round on the way, forward or back. Dwell and sample interval are those of the last
/// position of the plan. The time that a turn takes tells of parameters, and is not weighed.
///
/// A position slewed to carries the attitude error of its chain, which is integrated on to it. What
/// a caged one tells does not depend on what came before and is computed once, unless a term knows
/// the time or remembers, or a drift walks; then it is that in the last sample which the criterion
/// goes by. Does not depend on the number of threads.
Improvement improve_plan(const TestPlan& plan, const observability::RankedModel& model,
                         const Criterion& criterion, std::size_t count, int threads = 0,
                         const ImproveProgress& progress = {});

/// The same, judged by whatever judges: a pure function of what it says. Nothing if it ended
/// before.
std::optional<Improvement> improve_plan(const TestPlan& plan,
                                        const observability::RankedModel& model,
                                        const Criterion& criterion, std::size_t count,
                                        const JudgeStep& judge,
                                        const ImproveProgress& progress = {});

}  // namespace drift::planning
