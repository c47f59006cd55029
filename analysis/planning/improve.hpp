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

/// Adds `count` positions, greedily: each time the candidate that makes the criterion smallest
/// (candidates.hpp; the first of equals).
///
/// The information of a caged position does not depend on what came before and is computed once;
/// the posterior under each candidate is a low-rank update of its square root. A position slewed to
/// carries the attitude error of its chain: the chain is integrated on to it, its rows are
/// appended, and the same update acts on parameters and chain attitude together. Does not depend on
/// the number of threads.
Improvement improve_plan(const TestPlan& plan, const observability::RankedModel& model,
                         const Criterion& criterion, std::size_t count, int threads = 0,
                         const ImproveProgress& progress = {});

/// Square root S of a covariance P = S S^T of [psi of the present chain | x], 3 + n states.
struct JointPosterior {
  MatX S;                ///< shape (3 + n, 3 + n)
  Mat3 psi_information;  ///< on psi for known x
};

/// What an update makes of the parameters' covariance.
struct UpdatedBelief {
  VecX sigma;                  ///< learning ratios, shape n
  double half_log2_det = 0.0;  ///< of the parameters' covariance
  double value(const Criterion& criterion) const;
};

/// The posterior with rows J [psi | x] of a measurement of unit noise added, by a low-rank update:
/// with J S = L Q^T (QR of its transpose), P' = S (1 - Q Q^T + Q (1 + L^T L)^-1 Q^T) S^T. Sums of
/// squares alone: nothing cancels. J: shape (r, 3 + n), r may be 0.
UpdatedBelief updated_belief(const JointPosterior& posterior, const MatX& J);

/// Few rows with (nearly) the information of many: rank-revealing QR. What is left out sums to less
/// than 1e-11 of the prior information, which changes no posterior variance by more than that part.
MatX compressed(const MatX& rows);

/// Joint posterior of a plan's last chain and parameters.
JointPosterior joint_posterior(const observability::InformationSum& sum);

}  // namespace drift::planning
