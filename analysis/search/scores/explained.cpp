#include "analysis/search/scores/explained.hpp"

#include "core/estimate/layout.hpp"

namespace drift::search {

VecX taken_out(const inference::LinearProblem& problem, const FilterSpec& nominal,
               const BatchResult& before, const FilterSpec& better, const BatchResult& after) {
  const Layout layout = make_layout(nominal);
  const VecX moved =
      layout.scaled(theta_of(nominal, before)) - layout.scaled(theta_of(better, after));
  VecX out = inference::residual_of(problem, before) - inference::residual_of(problem, after) +
             problem.theta * moved;
  for (Eigen::Index k = 0; k < out.size(); ++k) {
    const auto chain = static_cast<std::size_t>(problem.drives[problem.tags[k].interval].chain);
    out[k] += problem.psi.row(k).dot(before.psi0_l[chain] - after.psi0_l[chain]) /
              nominal.initial_attitude;
  }
  return out;
}

}  // namespace drift::search
