#include <algorithm>

#include "core/base/decompose.hpp"
#include "core/estimate/batch.hpp"
#include "core/estimate/batch_equations.hpp"
#include "core/estimate/triangle.hpp"

namespace drift {

MatX information_root(const std::vector<ChainEquations>& chains, std::size_t parameters) {
  BatchEquations e;
  e.x = VecX::Zero(parameters);
  for (const auto& c : chains) {
    e.chains.push_back(triangle(c.rows));
    e.psi.push_back(Vec3::Zero());
  }
  return e.reduced(0.0).triangle.topLeftCorner(parameters, parameters);
}

std::vector<WeakDirection> weak_directions(const MatX& information_root, double limit) {
  const Eigensystem eigen = eigensystem(information_root.transpose() * information_root);
  std::vector<WeakDirection> weak;
  for (Eigen::Index k = 0; k < eigen.values.size(); ++k)
    if (eigen.values[k] < limit)
      weak.push_back({std::max(0.0, eigen.values[k]), eigen.vectors.col(k)});
  return weak;
}

}  // namespace drift
