#include "analysis/diagnosis/asides.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/inference/thresholds.hpp"

namespace drift::diagnosis {
namespace {

using inference::RemarkLimits;

double chi2_per_dof(const search::Fitted& e) {
  return e.fit.estimate.statistic /
         static_cast<double>(std::max<std::size_t>(1, e.fit.estimate.measured));
}

/// The rejected explanation that fits best.
const search::Refit& best_rejected(const search::Search& found) {
  return *std::ranges::min_element(found.rejected, {},
                                   [](const search::Refit& r) { return chi2_per_dof(r.after); });
}

}  // namespace

std::optional<NearestKnown> nearest_known(const search::Fitted& nominal,
                                          const search::Search& found) {
  if (found.rejected.empty()) return std::nullopt;
  const search::Refit& best = best_rejected(found);
  const double before = chi2_per_dof(nominal), after = chi2_per_dof(best.after);
  const double excess = before > 1.0 ? (before - std::max(1.0, after)) / (before - 1.0) : 0.0;
  if (excess < RemarkLimits::nearest) return std::nullopt;
  NearestKnown out{{}, before, after};
  for (const search::Choice& choice : best.choices) {
    const inference::Candidate& c = nominal.set.candidates[choice.candidate];
    out.effects.push_back({c.term, c.axis, c.label});
  }
  return out;
}

std::optional<remark::StrongestLeft> strongest_left(const search::Fitted& nominal,
                                                    const search::Search& found) {
  const search::Refit& best = best_rejected(found);
  const std::size_t k = best.remainder.strongest;
  if (k >= best.after.set.candidates.size() ||
      !(best.remainder.library > found.thresholds.library_threshold))
    return std::nullopt;
  remark::StrongestLeft out{{}, best.after.set.candidates[k].label};
  for (const search::Choice& choice : best.choices)
    out.labels.push_back(nominal.set.candidates[choice.candidate].label);
  return out;
}

std::optional<remark::BeyondPrior> beyond_prior(const BatchResult& nominal) {
  remark::BeyondPrior out;
  for (const ParameterEstimate& p : nominal.estimate.parameters) {
    const double off = p.prior_sigma > 0.0 ? std::abs(p.value - p.prior_mean) / p.prior_sigma : 0.0;
    if (off <= RemarkLimits::unphysical) continue;
    out.params.push_back(p.param);
    out.farthest = std::max(out.farthest, off);
  }
  if (out.params.empty()) return std::nullopt;
  return out;
}

std::optional<remark::OtherEquation> equation_against_other(const Diagnosis& d) {
  const bool closure_is_a_cause =
      std::ranges::any_of(d.causes, [](const search::Cause& c) { return c.term == closure_term; });
  if (!std::isfinite(d.other_equation_gain) || closure_is_a_cause) return std::nullopt;
  return remark::OtherEquation{d.nominal.coupling, d.other_equation_gain, !d.causes.empty()};
}

bool remark::OtherEquation::open() const {
  return gain >= -RemarkLimits::equation;
}

}  // namespace drift::diagnosis
