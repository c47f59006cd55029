#include "analysis/inference/misalignments.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include "analysis/inference/size_prior.hpp"
#include "core/physics/closure.hpp"

namespace drift::inference {

bool is_misalignment(std::size_t param) {
  const std::string_view group = TermLibrary::specs[param].group.view();
  return group == "eta" || group == "xi";
}

double log_gain_of_misalignments(const Layout& layout, const Projector& projector) {
  const Projector::Fit fit = projector.fit();
  return log_gain_of_misalignments(layout, fit.x, fit.covariance);
}

double log_gain_of_misalignments(const Layout& layout, const VecX& x, const MatX& of_all) {
  std::vector<Eigen::Index> rows;
  for (std::size_t k = 0; k < layout.size(); ++k)
    if (is_misalignment(layout.params[k])) rows.push_back(static_cast<Eigen::Index>(k));
  if (rows.empty()) return 0.0;
  MatX covariance = of_all(rows, rows);
  if (const auto at = std::ranges::find(layout.params, closure_param); at != layout.params.end()) {
    const auto lambda = at - layout.params.begin();
    const VecX with_lambda = of_all(rows, lambda);
    if (const double own = of_all(lambda, lambda); own > 0.0)  // else it is held
      covariance -= with_lambda * with_lambda.transpose() / own;
  }
  return log_gain_of_sizes_made_small(x(rows), covariance);
}

}  // namespace drift::inference
