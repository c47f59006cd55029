#include <algorithm>
#include <cmath>
#include <limits>

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
  std::vector<WeakDirection> weak;
  if (information_root.size() == 0 || !information_root.allFinite()) return weak;
  const RightSingular svd = right_singular(information_root);
  for (Eigen::Index k = svd.values.size(); k-- > 0;)
    if (const double information = std::pow(svd.values[k], 2); information < limit)
      weak.push_back({information, svd.vectors.col(k)});
  return weak;
}

double rounding_signal(const MatX& information_root) {
  return static_cast<double>(information_root.cols()) * std::numeric_limits<double>::epsilon() *
         information_root.norm();
}

std::size_t exactly_unseen(const std::vector<WeakDirection>& directions,
                           const MatX& information_root) {
  const double rounding = rounding_signal(information_root);
  return static_cast<std::size_t>(std::ranges::count_if(
      directions, [&](const WeakDirection& d) { return std::sqrt(d.information) <= rounding; }));
}

}  // namespace drift
