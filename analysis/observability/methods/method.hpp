#pragma once

#include <string>

#include "analysis/observability/information_by_position.hpp"
#include "analysis/observability/pwcs.hpp"
#include "analysis/observability/ranking.hpp"

namespace drift::observability {

/// What a method may look at. The bins of `plan` and the course through them say where the
/// information came from.
struct Ranked {
  const Ranking& ranking;
  const PwcsRank& pwcs;
  const LinearisedPlan& plan;
  const InformationCourse& course;
  const TestPlan& positions;

  const ParameterRank& parameter(std::size_t state) const { return ranking.parameters[state]; }
};

/// A way to rank states beside the learning ratio. Each is declared at the end of its own file;
/// other_methods.cpp lists them all.
struct Method {
  std::string key;    ///< "conditional", "svd", "ham_brown"
  std::string words;  ///< what it is
  /// Of each state, the larger the better observable; layout order.
  VecX (*score)(const Ranked& ranked);
  /// Why a state is ranked higher (or lower) here than by the learning ratio.
  std::string (*reason)(const Ranked& ranked, std::size_t state, bool higher_here);
};

/// SVD degree of observability (physics.md 5.3) of the states of the stripped observability matrix
/// Q = U S V^T: state k is given the s_i whose |u_i^T y v_ik / s_i| is largest, relative to the
/// best of the attitude errors (which gimbals or accelerometers measure directly). The method needs
/// a measurement: y = Q x with every prior-scaled state at +1, for which u_i^T y / s_i = v_i^T x.
/// Shape of the result: parameters, in layout order.
VecX svd_degrees(const PwcsRank& pwcs);

/// Degree of observability by Ham and Brown (1983; physics.md 5.4): eigenvalues of the posterior
/// covariance, prior-scaled and normalised to the sum n. A parameter is given the eigenvalue of the
/// direction it takes most part in, with a minus sign: large is well observed.
VecX ham_brown_score(const Ranking& ranking);

}  // namespace drift::observability
