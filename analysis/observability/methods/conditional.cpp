#include <fmt/format.h>

#include "analysis/observability/methods/method.hpp"

namespace drift::observability {
namespace {

VecX conditional_of(const Ranked& r) {
  VecX conditional(static_cast<Eigen::Index>(r.ranking.layout.size()));
  for (Eigen::Index k = 0; k < conditional.size(); ++k) {
    const ParameterRank& p = r.parameter(static_cast<std::size_t>(k));
    conditional[k] = -p.conditional_sigma / p.prior_sigma;
  }
  return conditional;
}

std::string conditional_reason(const Ranked& r, std::size_t state, bool higher_here) {
  const ParameterRank& p = r.parameter(state);
  if (!higher_here)
    return fmt::format("little else is mistaken for it: collinearity {:.3g}, others lose more",
                       p.collinearity());
  return fmt::format(
      "seen well if the others were known, but confused with {} (correlation {:.4f}, "
      "collinearity {:.3g})",
      TermLibrary::specs[r.ranking.layout.params[p.partner]].key.view(), p.correlation,
      p.collinearity());
}

}  // namespace

Method conditional() {
  return {"conditional", "conditional sigma: all other parameters known (column norm)",
          conditional_of, conditional_reason};
}

}  // namespace drift::observability
