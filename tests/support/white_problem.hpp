#pragma once

#include "analysis/inference/linear_problem.hpp"

namespace drift::test {

/// A linearised test of white noise alone: what is given is whitened already.
inline inference::LinearProblem white_problem(const MatX& theta, const MatX& extra,
                                              const VecX& r0) {
  inference::LinearProblem p;
  p.tags.resize(static_cast<std::size_t>(r0.size()));
  p.drives.resize(1);
  p.psi = MatX::Zero(r0.size(), 3);
  p.r0 = r0;
  p.weight = VecX::Ones(r0.size());
  p.theta = theta;
  p.extra = extra;
  return p;
}

}  // namespace drift::test
