#pragma once

#include "core/estimate/batch_problem.hpp"

namespace drift {

/// What the rows leave out of half the curvature of a cost, by the steps that were made: the sum of
/// residuals times the bend of what they predict, over the scaled parameters. Symmetric rank one,
/// of the change of the rows alone (Dennis, Gay and Welsch 1981, eq. 3.3 to 3.5; Nocedal and
/// Wright, Numerical Optimization, 6.2 and 10.3). Little where the model is nearly linear; more
/// than the rows where the moment of a jump lies in a sample whose residual is large.
class SecondOrder {
 public:
  /// One step; nothing is known any more where both have not the same rows.
  void learn(const Evaluation& from, const Evaluation& to);
  /// Shape (parameters, parameters); empty where nothing is known.
  const MatX& matrix() const { return S_; }
  void forget() { S_.resize(0, 0); }

 private:
  MatX S_;
};

}  // namespace drift
