#include <cmath>

#include "analysis/identification/counted_start.hpp"
#include "analysis/inference/fit_thresholds.hpp"
#include "analysis/report/identify/sections.hpp"
#include "core/estimate/start_consistency.hpp"

namespace drift::report {
namespace {

using inference::WorthLimits;

/// The part of a parameter's variance that is the prior's, along combinations of which the data say
/// nothing: there the variance is one in units of the prior.
double share_of_sums(const FilterView& v, std::size_t state, const ParameterEstimate& p) {
  double variance = 0.0;
  for (const WeakDirection& d : v.summary.unseen)
    variance += std::pow(d.direction[static_cast<Eigen::Index>(state)], 2);
  return variance / std::pow(p.learning_ratio(), 2);
}

}  // namespace

bool believed(const FilterView& v) {
  return identification::fits(judged(v));
}

ParameterVerdict verdict_of(const FilterView& v, std::size_t state) {
  const EstimateResult& result = judged(v);
  ParameterVerdict out;
  out.param = v.summary.layout.params[state];
  const ParameterEstimate* p = result.find(out.param);
  if (p == nullptr) {
    out.worth = Worth::untrusted;
    return out;
  }
  if (v.id.truth) out.off = std::abs(p->value - v.id.truth->theta[out.param]) / p->sigma;
  const double ratio = v.summary.spread[state].counted;
  if (out.off > WorthLimits::surely_wrong)
    out.worth = Worth::wrong;
  else if (!believed(v))
    out.worth = Worth::untrusted;
  else if (p->learning_ratio() > WorthLimits::nothing_learned)
    out.worth = Worth::prior_only;
  else if (std::isfinite(ratio) && start_verdict(ratio) == StartVerdict::depends_on_start)
    out.worth = Worth::start_dependent;
  else if (p->learning_ratio() > WorthLimits::half_learned &&
           share_of_sums(v, state, *p) > WorthLimits::mostly)
    out.worth = Worth::sum_only;
  return out;
}

Cell verdict_cell(const ParameterVerdict& verdict) {
  switch (verdict.worth) {
    case Worth::wrong:
      return {fmt::format("wrong by {:.0f} sigma", verdict.off), Tone::bad};
    case Worth::untrusted:
      return {"not to be trusted (misfit)", Tone::bad};
    case Worth::start_dependent:
      return {"depends on start", Tone::bad};
    case Worth::prior_only:
      return {"prior only", Tone::doubtful};
    case Worth::sum_only:
      return {"in a sum alone", Tone::doubtful};
    case Worth::learned:
      break;
  }
  return {"learned", Tone::good};
}

}  // namespace drift::report
