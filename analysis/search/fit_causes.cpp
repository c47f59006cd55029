#include "analysis/search/fit_causes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/equation/closure_profile.hpp"
#include "mc/task/campaign.hpp"

namespace drift::search {
namespace {

/// Distance of the points of the library's grid about a value, SI: what the grid leaves open.
double grid_spacing(const inference::Candidate& c, std::size_t param, double value) {
  constexpr double none = std::numeric_limits<double>::infinity();
  double below = none, above = none;
  bool on_grid = false;
  for (const inference::Variant& v : c.variants)
    for (const auto& [p, other] : v.settings) {
      if (p != param || v.between) continue;
      on_grid = on_grid || other == value;
      if (other < value) below = std::min(below, value - other);
      if (other > value) above = std::min(above, other - value);
    }
  const double spacing =
      on_grid || below == none || above == none ? std::min(below, above) : below + above;
  return std::isfinite(spacing) ? spacing : 0.0;
}

FilterSpec with_causes(const FilterSpec& nominal, const inference::CandidateSet& set,
                       const std::vector<Choice>& choices) {
  FilterSpec filter = nominal;
  for (const Choice& choice : choices) {
    const inference::Candidate& c = set.candidates[choice.candidate];
    for (const std::size_t i : c.params) {
      filter.active.set(i);
      filter.priors[i] = nominal.believed(i);
      if (i == closure_param) filter.coupling = family_of(filter.coupling);
    }
    for (const auto& [i, value] : c.variants[choice.variant].settings) {
      filter.active.set(i);
      const bool refined = TermLibrary::specs[i].kind == ParamKind::nonlinear;
      const double spacing = refined ? grid_spacing(c, i, value) : 0.0;
      filter.priors[i] = spacing > 0.0 ? normal(value, spacing) : fixed(value);
    }
    // The rest of the term at the library's defaults: a term may need all its parameters.
    const TermInfo& term = TermLibrary::terms[*TermLibrary::find_term(c.term)];
    for (std::size_t i = term.first; i < term.first + term.count; ++i)
      if (!filter.active[i] && TermLibrary::specs[i].prior.sigma() <= 0.0) {
        filter.active.set(i);
        filter.priors[i] = nominal.believed(i);
      }
  }
  return filter;
}

Expectation expect(const Fitted& nominal, const std::vector<Choice>& choices) {
  Expectation out{theta_of(nominal.filter, nominal.fit), {}, false};
  for (const Choice& choice : choices)
    for (const auto& [param, value] :
         nominal.set.candidates[choice.candidate].variants[choice.variant].settings)
      out.theta[param] = value;
  const VecX scaled = expected_amplitudes(nominal.projected, columns_of(nominal.set, choices));
  Eigen::Index next = 0;
  for (const Choice& choice : choices)
    for (const std::size_t i : nominal.set.candidates[choice.candidate].params) {
      const double base = value_left_out(i, nominal.filter.coupling);
      out.theta[i] = base + scaled[next++] * nominal.filter.believed(i).sigma();
      out.amplitude.emplace_back(i, out.theta[i] - base);
      if (i != closure_param) continue;
      out.lambda_among_them = true;
      out.theta[i] = std::clamp(out.theta[i], 0.0, 1.0);
    }
  return out;
}

/// lambda and the misalignments are bilinear, a narrow bent valley: from both equations, fitted
/// first, from the nominal fit and, as that may be far off, from the prior.
std::vector<BatchResult> fits_from_both_ends(const Fitted& nominal, const FilterSpec& filter,
                                             const MeasuredTest& test) {
  const Theta theta = theta_of(nominal.filter, nominal.fit);
  return mc::run_campaign(4, [&](std::size_t k) {
    const double end = static_cast<double>(k % 2);
    FilterSpec held = filter;
    held.priors[closure_param] = fixed(end);
    Theta from = k < 2 ? theta : make_layout(nominal.filter).theta;
    from[closure_param] = end;
    const BatchResult first = fit_batch(held, test, from);
    return fit_batch(filter, test, theta_of(held, first));
  });
}

}  // namespace

CauseFit fit_causes(const Fitted& nominal, const MeasuredTest& test,
                    const std::vector<Choice>& choices) {
  CauseFit out{
      with_causes(nominal.filter, nominal.set, choices), {}, expect(nominal, choices), 0.0};
  const auto fit_from = [&](const Theta& from) { return fit_batch(out.filter, test, from); };
  out.fit = fit_from(out.expected.theta);
  if (!out.expected.lambda_among_them) return out;
  for (BatchResult& other : fits_from_both_ends(nominal, out.filter, test))
    if (other.estimate.statistic < out.fit.estimate.statistic) out.fit = std::move(other);
  if (const auto profile = equation::profile_closure(out.filter, test, out.fit,
                                                     nominal.problem.weight, nominal.noise.model)) {
    out.narrowed =
        std::max(0.0, std::log(out.filter.priors[closure_param].sigma() / profile->sigma));
    out.filter.priors[closure_param] = normal(profile->value, profile->sigma);
    out.fit = fit_from(theta_of(out.filter, profile->fit));
  }
  return out;
}

}  // namespace drift::search
