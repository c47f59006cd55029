#include "analysis/inference/linear_problem.hpp"

namespace drift::inference {

LinearProblem LinearProblem::with_mean(const std::vector<int>& columns) const {
  MatX both(rows(), theta.cols() + static_cast<Eigen::Index>(columns.size()));
  both << theta, extra(Eigen::all, columns);
  return {*this, std::move(both), extra};
}

LinearProblem LinearProblem::with_mean_alone(const std::vector<int>& columns) const {
  MatX both(rows(), theta.cols() + static_cast<Eigen::Index>(columns.size()));
  both << theta, extra(Eigen::all, columns);
  return {*this, std::move(both), MatX(rows(), 0)};
}

LinearProblem LinearProblem::bare() const {
  return {*this, theta, MatX(rows(), 0)};
}

LinearProblem LinearProblem::without(const std::vector<bool>& intervals) const {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < rows(); ++k)
    if (!intervals[tags[static_cast<std::size_t>(k)].interval]) kept.push_back(k);
  LinearProblem out{*this, theta(kept, Eigen::all), extra(kept, Eigen::all)};
  out.tags.clear();
  for (const Eigen::Index k : kept) out.tags.push_back(tags[static_cast<std::size_t>(k)]);
  out.psi = psi(kept, Eigen::all);
  out.r0 = r0(kept);
  out.weight = weight(kept);
  return out;
}

}  // namespace drift::inference
