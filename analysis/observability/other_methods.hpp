#pragma once

#include <string>
#include <vector>

#include "analysis/observability/methods/method.hpp"

namespace drift::observability {

/// A ranking by another method: a score for each state, the larger the better observable.
struct MethodRanking {
  std::string key;        ///< of the method
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

/// The learning ratio beside the other methods, with where they disagree and why.
std::vector<MethodRanking> compare_methods(const Ranked& ranked);

}  // namespace drift::observability
