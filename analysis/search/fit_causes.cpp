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
      const bool refined = TermLibrary::specs[i].continuous();
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

/// With lambda among the causes the cost may have several valleys: from the better fit at each of
/// both equations, of those from the nominal fit and, as that may be far off, from the prior.
BatchResult fit_from_both_ends(const Fitted& nominal, const FilterSpec& filter,
                               const MeasuredTest& test, const Theta& expected) {
  const Theta starts[2] = {expected, make_layout(filter).theta};
  const auto at_ends = mc::run_campaign(4, [&](std::size_t k) {
    const double end = static_cast<double>(k % 2);
    FilterSpec held = filter;
    held.priors[closure_param] = fixed(end);
    Theta from = starts[k / 2];
    from[closure_param] = end;
    // Another fit begins there: a step of a hundredth of a sigma is as good as none.
    BatchResult fit =
        fit_batch_from(held, test, from, nominal.fit.psi0_l,
                       {.tolerance = 1e-2, .result = BatchOptions::Result::estimates});
    return std::pair(theta_of(held, fit), std::move(fit));
  });
  auto fits = mc::run_campaign(2, [&](std::size_t end) {
    const bool prior =
        at_ends[end + 2].second.estimate.statistic < at_ends[end].second.estimate.statistic;
    const auto& [theta, fit] = at_ends[prior ? end + 2 : end];
    return fit_batch_from(filter, test, theta, fit.psi0_l);
  });
  return std::move(*std::ranges::min_element(
      fits, {}, [](const BatchResult& f) { return f.estimate.statistic; }));
}

}  // namespace

BatchResult CauseFit::with_closure_sigma(BatchResult given) const {
  for (ParameterEstimate& p : given.estimate.parameters)
    if (closure_sigma > 0.0 && p.param == closure_param) p.sigma = closure_sigma;
  return given;
}

CauseFit fit_causes(const Fitted& nominal, const MeasuredTest& test,
                    const std::vector<Choice>& choices, const inference::NoiseModel& noise) {
  CauseFit out{with_causes(nominal.filter, nominal.set, choices), {}, expect(nominal, choices)};
  const auto fit_from = [&](const Theta& from, const BatchResult& beside) {
    return fit_batch_from(out.filter, test, from, beside.psi0_l);
  };
  if (!out.expected.lambda_among_them) {
    out.fit = fit_from(out.expected.theta, nominal.fit);
    return out;
  }
  out.fit = fit_from_both_ends(nominal, out.filter, test, out.expected.theta);
  const equation::ClosureWeighed weighed =
      equation::weigh_closure(out.filter, test, out.fit, nominal.problem.weight, noise);
  out.loss_of_nominal =
      weighed.loss_at_end[value_left_out(closure_param, nominal.filter.coupling) < 0.5 ? 0 : 1];
  if (const auto& profile = weighed.profile) {
    // Free again it would go back to where the joint fit has it: it is all but held, and the
    // evidence of that one value stands for what all of them have together.
    constexpr double held = 1e-3;
    const Prior own = out.filter.priors[closure_param];
    const double z = (profile->value - own.mean()) / own.sigma();
    out.narrowed = std::max(0.0, std::log(own.sigma() / profile->sigma) + 0.5 * z * z);
    out.closure_sigma = profile->sigma;
    out.filter.priors[closure_param] = normal(profile->value, held * profile->sigma);
    out.fit = out.with_closure_sigma(fit_from(theta_of(out.filter, profile->fit), profile->fit));
  }
  return out;
}

}  // namespace drift::search
