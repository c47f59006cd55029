#pragma once

#include <string>
#include <vector>

#include "analysis/observability/information_by_position.hpp"
#include "analysis/observability/pwcs.hpp"
#include "analysis/observability/ranking.hpp"

namespace drift::observability {

/// A ranking by another method: a score for each state, the larger the better observable.
struct MethodRanking {
  std::string key;        ///< "conditional", "svd", "ham_brown"
  std::string method;     ///< in words
  VecX score;             ///< layout order
  double spearman = 0.0;  ///< rank correlation with the learning ratio
  struct Disagreement {
    std::size_t state = 0;
    double rank_here = 0.0, rank_learning = 0.0;  ///< 1 = best observable; ties share their mean
    std::string reason;
  };
  std::vector<Disagreement> disagreements;  ///< the (at most three) worst, if beyond a quarter of n
};

/// Rank correlation of two scores; equal scores share their mean rank. NaN with fewer than two
/// numbers, or where all of one are equal.
double spearman(const VecX& a, const VecX& b);

/// Ranks 1 .. n by falling score; those equal to 1e-9 of the larger share their mean.
VecX ranks_of(const VecX& score);

/// SVD degree of observability (physics.md 5.3) of the states of the stripped observability matrix
/// Q = U S V^T: state k is given the s_i whose |u_i^T y v_ik / s_i| is largest, relative to the
/// best of the attitude errors (which gimbals or accelerometers measure directly). The method needs
/// a measurement: y = Q x with every prior-scaled state at +1, for which u_i^T y / s_i = v_i^T x.
/// Shape of the result: parameters, in layout order.
VecX svd_degrees(const PwcsRank& pwcs);

/// Degree of observability by Ham and Brown (1983; physics.md 5.4): eigenvalues of the posterior
/// covariance, prior-scaled and normalised to the sum n. A parameter is given the eigenvalue of the
/// direction it takes most part in, with a minus sign: large is well observed.
VecX ham_brown(const Ranking& ranking);

/// The learning ratio beside the other methods, with where they disagree and why. The bins of
/// `plan` and the course through them say where the information came from.
std::vector<MethodRanking> compare_methods(const Ranking& ranking, const PwcsRank& pwcs,
                                           const LinearisedPlan& plan,
                                           const InformationCourse& course,
                                           const TestPlan& positions);

}  // namespace drift::observability
