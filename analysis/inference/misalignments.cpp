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
  std::vector<Eigen::Index> rows;
  for (std::size_t k = 0; k < layout.size(); ++k)
    if (is_misalignment(layout.params[k])) rows.push_back(static_cast<Eigen::Index>(k));
  if (rows.empty()) return 0.0;
  const Projector::Fit fit = projector.fit();
  MatX covariance = fit.covariance(rows, rows);
  if (const auto at = std::ranges::find(layout.params, closure_param); at != layout.params.end()) {
    const auto lambda = at - layout.params.begin();
    const VecX with_lambda = fit.covariance(rows, lambda);
    covariance -= with_lambda * with_lambda.transpose() / fit.covariance(lambda, lambda);
  }
  return log_gain_of_sizes_made_small(fit.x(rows), covariance);
}

}  // namespace drift::inference
