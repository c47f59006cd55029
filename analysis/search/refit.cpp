#include "analysis/search/refit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/equation/closure_profile.hpp"
#include "analysis/search/settle_noise.hpp"
#include "analysis/search/size_prior.hpp"
#include "mc/task/campaign.hpp"

namespace drift::search {
namespace {

constexpr auto lambda = TermLibrary::index("lambda");
constexpr double quiet_p_value = 0.01;  // of a free-form input beside the cause: nothing is left

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

/// Points of the library's grid at which a candidate can be seen at all.
double grid_points(const Examination& e, std::size_t candidate) {
  const auto& variants = e.set.candidates[candidate].variants;
  std::size_t n = 0;
  for (std::size_t v = 0; v < variants.size(); ++v)
    n += !variants[v].between && e.field->contrasts[candidate][v].dof > 0;
  return static_cast<double>(std::max<std::size_t>(1, n));
}

/// Change of the log evidence if the amplitudes of the causes are of unknown size (size_prior.hpp).
/// lambda is no amplitude: it lies between 0 and 1.
double gain_of_sizes(const inference::CandidateSet& set, const Refit& r) {
  const inference::Projector::Fit fit = r.after.projector->fit({});
  const Layout layout = make_layout(r.filter);
  std::vector<Eigen::Index> rows;
  std::vector<int> cause;
  int causes = 0;
  for (const Choice& choice : r.choices) {
    const std::size_t before = rows.size();
    for (const std::size_t i : set.candidates[choice.candidate].params) {
      const auto at = std::find(layout.params.begin(), layout.params.end(), i);
      if (i == lambda || at == layout.params.end()) continue;
      rows.push_back(at - layout.params.begin());
      cause.push_back(causes);
    }
    causes += rows.size() > before;
  }
  return log_gain_of_sizes(fit.x(rows), fit.covariance(rows, rows), cause);
}

/// Whether each of simultaneous causes has an amplitude that is clearly not zero. A change of
/// equation is judged by the fit alone: where its weight ends is seldom known well.
bool all_needed(const inference::CandidateSet& set, const Refit& r) {
  constexpr double clearly = 3.0;  // sigma
  return std::all_of(r.choices.begin(), r.choices.end(), [&](const Choice& choice) {
    const auto& params = set.candidates[choice.candidate].params;
    return std::any_of(params.begin(), params.end(), [&](std::size_t i) {
      const ParameterEstimate* p = r.after.fit.estimate.find(i);
      return i == lambda || !p ||
             std::abs(p->value - TermLibrary::specs[i].prior_si().mean()) >= clearly * p->sigma;
    });
  });
}

bool may_be_refined(const ParamSpec& spec) {
  return spec.kind == ParamKind::nonlinear;
}

}  // namespace

VecX expected_amplitudes(const inference::Projected& p, const std::vector<int>& columns) {
  const auto n = static_cast<Eigen::Index>(columns.size());
  MatX C(n, n);
  VecX g(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    g[i] = p.g[columns[i]];
    for (Eigen::Index k = 0; k < n; ++k) C(i, k) = p.C(columns[i], columns[k]);
  }
  return (C + MatX::Identity(n, n))
      .ldlt()
      .solve(g);  // with the unit prior, so that nothing runs away
}

FilterSpec with_causes(const FilterSpec& nominal, const inference::CandidateSet& set,
                       const std::vector<Choice>& choices) {
  FilterSpec filter = nominal;
  for (const Choice& choice : choices) {
    const inference::Candidate& c = set.candidates[choice.candidate];
    for (const std::size_t i : c.params) {
      filter.active.set(i);
      filter.priors[i] = TermLibrary::specs[i].prior_si();
      if (i == lambda && (filter.coupling == Coupling::eq5 || filter.coupling == Coupling::eq6))
        filter.coupling = Coupling::lambda;
    }
    for (const auto& [i, value] : c.variants[choice.variant].settings) {
      filter.active.set(i);
      const double spacing =
          may_be_refined(TermLibrary::specs[i]) ? grid_spacing(c, i, value) : 0.0;
      filter.priors[i] = spacing > 0.0 ? normal(value, spacing) : fixed(value);
    }
    // The rest of the term at the library's defaults: a term may need all its parameters.
    const TermInfo& term = TermLibrary::terms[*TermLibrary::find_term(c.term)];
    for (std::size_t i = term.first; i < term.first + term.count; ++i)
      if (!filter.active[i] && TermLibrary::specs[i].prior.sigma() <= 0.0) {
        filter.active.set(i);
        filter.priors[i] = TermLibrary::specs[i].prior_si();
      }
  }
  return filter;
}

Refit refit(const Examination& nominal, const inference::Test& test,
            const std::vector<Choice>& choices, const Nulls& nulls) {
  Refit out;
  out.choices = choices;
  out.filter = with_causes(nominal.filter, nominal.set, choices);
  const Theta theta = inference::theta_of(nominal.filter, nominal.fit);

  Theta start = theta;
  std::vector<std::pair<std::size_t, double>> expected;
  bool family = false;
  std::vector<int> columns;
  for (const Choice& choice : choices) {
    const inference::Variant& v = nominal.set.candidates[choice.candidate].variants[choice.variant];
    columns.insert(columns.end(), v.columns.begin(), v.columns.end());
    for (const auto& [param, value] : v.settings) start[param] = value;
  }
  const VecX amplitudes = expected_amplitudes(nominal.projector->candidates(), columns);
  std::size_t next = 0;
  for (const Choice& choice : choices)
    for (const std::size_t i : nominal.set.candidates[choice.candidate].params) {
      const double base = i == lambda && nominal.filter.coupling == Coupling::eq6 ? 1.0 : 0.0;
      start[i] = base + amplitudes[next++] * TermLibrary::specs[i].prior_si().sigma();
      expected.emplace_back(i, start[i] - base);
      if (i == lambda) {
        family = true;
        start[i] = std::clamp(start[i], 0.0, 1.0);
      }
    }

  const auto fit_from = [&](const Theta& from) {
    return fit_batch(out.filter, test.timeline, test.readout, test.measured, from);
  };
  BatchResult best = fit_from(start);
  if (family) {
    // lambda and the misalignments are bilinear, a narrow bent valley: from both equations, fitted
    // first, from the nominal fit and, as that may be far off, from the prior.
    const auto from_end = [&](std::size_t k) {
      const double end = static_cast<double>(k % 2);
      FilterSpec held = out.filter;
      held.priors[lambda] = fixed(end);
      Theta from = k < 2 ? theta : make_layout(nominal.filter).theta;
      from[lambda] = end;
      return fit_from(inference::theta_of(
          held, fit_batch(held, test.timeline, test.readout, test.measured, from)));
    };
    for (BatchResult& other : mc::run_campaign(4, from_end))
      if (other.estimate.statistic < best.estimate.statistic) best = std::move(other);
  }
  double narrowed = 0.0;  // log of how much narrower the prior of lambda has become
  if (family)
    if (const auto profile = equation::profile_closure(
            out.filter, test, best, nominal.problem.weight, nominal.noise.model)) {
      narrowed = std::log(out.filter.priors[lambda].sigma() / profile->sigma);
      out.filter.priors[lambda] = normal(profile->value, profile->sigma);
      best = fit_from(inference::theta_of(out.filter, profile->fit));
    }
  out.after = examine(out.filter, test, best, nullptr, nominal.noise.driven);
  settle_noise(out.after, test, nulls.library_threshold, 2,
               1);  // a second effect may hide in the noise
  for (const auto& [param, value] :
       expected)  // lambda is a jump: its slope at the nominal fit says nothing
    if (const ParameterEstimate* p = best.estimate.find(param); p != nullptr && param != lambda)
      if (std::abs(value) > 2.0 * p->sigma && p->value * value < 0.0) out.sign_agrees = false;

  // What is left, without the members of the chosen families.
  for (std::size_t k = 0; k < out.after.scores.size(); ++k) {
    const inference::Candidate& c = out.after.set.candidates[k];
    const bool own = std::any_of(choices.begin(), choices.end(), [&](const Choice& choice) {
      const inference::Candidate& chosen = nominal.set.candidates[choice.candidate];
      return chosen.term == c.term && (chosen.params == c.params || chosen.contains(c));
    });
    if (own || out.after.scores[k].strength <= out.remainder.library) continue;
    out.remainder.library = out.after.scores[k].strength;
    out.remainder.strongest = k;
  }
  for (const inference::PositionScan& s : out.after.scans)
    for (const double T : s.T)
      out.remainder.scan = std::max(out.remainder.scan, stats::strength(T, 1));
  out.excess = std::max(out.remainder.library - nulls.library_threshold,
                        out.remainder.scan - nulls.scan_threshold);
  if (family)  // another equation must be another one: an interval that holds the nominal weight
               // names nothing
    if (const ParameterEstimate* p = best.estimate.find(lambda)) {
      const double base = nominal.filter.coupling == Coupling::eq6 ? 1.0 : 0.0;
      out.nameable = std::abs(p->value - base) > 3.0 * p->sigma;
    }
  if (choices.size() > 1 && !all_needed(nominal.set, out))
    out.excess = std::numeric_limits<double>::infinity();
  if (out.tolerable()) {
    // Many small traces in one equation that no window and no candidate has alone.
    out.after.lone = inference::strongest_lone_input(out.after.problem, out.after.noise.model);
    out.excess = std::max(out.excess, std::log(quiet_p_value / out.after.lone.p_value));
  }

  // Each variant of a grid was one try; the refit took the best of them.
  double tries = 0.0;
  for (const Choice& choice : choices) tries += std::log(grid_points(nominal, choice.candidate));
  out.log_bayes = 0.5 * (out.after.log_likelihood2() - nominal.log_likelihood2()) - tries -
                  std::max(0.0, narrowed) + gain_of_sizes(nominal.set, out);
  return out;
}

}  // namespace drift::search
