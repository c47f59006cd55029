#include "analysis/search/refit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "analysis/inference/thresholds.hpp"
#include "analysis/search/fit_causes.hpp"
#include "analysis/search/settle_noise.hpp"
#include "analysis/search/size_prior.hpp"

namespace drift::search {
namespace {

using inference::EffortLimits;
using inference::WeighLimits;

/// Points of the library's grid at which a candidate can be seen at all.
double grid_points(const Fitted& e, std::size_t candidate) {
  const auto& variants = e.set.candidates[candidate].variants;
  std::size_t n = 0;
  for (std::size_t v = 0; v < variants.size(); ++v)
    n += !variants[v].between && e.contrasts[candidate][v].dof > 0;
  return static_cast<double>(std::max<std::size_t>(1, n));
}

/// Change of the log evidence if the amplitudes of the causes are of unknown size (size_prior.hpp).
/// lambda is no amplitude: it lies between 0 and 1.
double gain_of_sizes(const inference::CandidateSet& set, const Refit& r) {
  const inference::Projector::Fit fit = r.after.projector->fit();
  const Layout layout = make_layout(r.filter);
  std::vector<Eigen::Index> rows;
  std::vector<int> cause;
  int causes = 0;
  for (const Choice& choice : r.choices) {
    const std::size_t before = rows.size();
    for (const std::size_t i : set.candidates[choice.candidate].params) {
      const auto at = std::find(layout.params.begin(), layout.params.end(), i);
      if (i == closure_param || at == layout.params.end()) continue;
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
  return std::all_of(r.choices.begin(), r.choices.end(), [&](const Choice& choice) {
    const auto& params = set.candidates[choice.candidate].params;
    return std::any_of(params.begin(), params.end(), [&](std::size_t i) {
      const ParameterEstimate* p = r.after.fit.estimate.find(i);
      return i == closure_param || !p ||
             std::abs(p->value - r.filter.believed(i).mean()) >= WeighLimits::needed * p->sigma;
    });
  });
}

/// lambda is a jump: its slope at the nominal fit says nothing.
bool signs_agree(const Expectation& expected, const BatchResult& fit) {
  return std::ranges::all_of(expected.amplitude, [&](const auto& a) {
    const ParameterEstimate* p = fit.estimate.find(a.first);
    return p == nullptr || a.first == closure_param ||
           std::abs(a.second) <= WeighLimits::sign * p->sigma || p->value * a.second >= 0.0;
  });
}

/// What is left, without the members of the chosen families.
Remainder left_by(const Fitted& after, const inference::CandidateSet& set,
                  const std::vector<Choice>& choices) {
  Remainder out;
  for (std::size_t k = 0; k < after.scores.size(); ++k) {
    if (after.scores[k].strength <= out.library ||
        of_a_chosen_family(set, choices, after.set.candidates[k]))
      continue;
    out.library = after.scores[k].strength;
    out.strongest = k;
  }
  for (const inference::PositionScan& s : after.scans)
    for (const double T : s.T) out.scan = std::max(out.scan, stats::strength(T, 1));
  return out;
}

/// The filter with a prior as wide as each amplitude that is larger than its own; nothing if none
/// is. What a narrow prior holds back of a large effect its twins would take, and it is no second
/// one: a prior cost of 36 at six sigma.
std::optional<FilterSpec> with_room_for_sizes(const inference::CandidateSet& set, const Refit& r) {
  std::optional<FilterSpec> roomy;
  for (const Choice& choice : r.choices)
    for (const std::size_t i : set.candidates[choice.candidate].params) {
      const ParameterEstimate* p = r.after.fit.estimate.find(i);
      const Prior prior = r.filter.believed(i);
      if (i == closure_param || !p || !(std::abs(p->value - prior.mean()) > prior.sigma()))
        continue;
      if (!roomy) roomy = r.filter;
      roomy->priors[i] = normal(prior.mean(), std::abs(p->value - prior.mean()));
    }
  return roomy;
}

/// Another equation must be another one: an interval that holds the nominal weight names nothing.
bool is_another_equation(Coupling nominal, const BatchResult& fit) {
  const ParameterEstimate* p = fit.estimate.find(closure_param);
  return p == nullptr || std::abs(p->value - value_left_out(closure_param, nominal)) >
                             WeighLimits::other_lambda * p->sigma;
}

/// Each variant of a grid was one try; the refit took the best of them.
double log_tries(const Fitted& nominal, const std::vector<Choice>& choices) {
  double sum = 0.0;
  for (const Choice& choice : choices) sum += std::log(grid_points(nominal, choice.candidate));
  return sum;
}

}  // namespace

NoiseKinds noise_beside(const Fitted& nominal) {
  return nominal.noise.driven ? NoiseKinds::driving_too : NoiseKinds::white;
}

Refit refit(const Fitted& nominal, const MeasuredTest& test, const std::vector<Choice>& choices,
            const ChanceThresholds& thresholds, NoiseKinds kinds) {
  const auto [filter, fit, expected, narrowed] = fit_causes(nominal, test, choices);
  Refit out;
  out.choices = choices;
  out.filter = filter;
  out.after = examine(filter, test, fit, kinds);
  // A second effect may hide in the noise; beside a cause noise stays where it is credible.
  if (const auto settled = settle_noise(out.after, EffortLimits::noise_tries_beside);
      settled && settled->probability > inference::SearchLimits::credible)
    out.after = with_noise(std::move(out.after), test.timeline, settled->noise);
  out.sign_agrees = signs_agree(expected, fit);
  out.nameable = !expected.lambda_among_them || is_another_equation(nominal.filter.coupling, fit);
  const auto look_at_rest = [&](const Fitted& after) {
    out.remainder = left_by(after, nominal.set, choices);
    out.excess = std::max(out.remainder.library - thresholds.library_threshold,
                          out.remainder.scan - thresholds.scan_threshold);
  };
  look_at_rest(out.after);
  if (out.excess > 0.0)
    if (const auto roomy = with_room_for_sizes(nominal.set, out))
      look_at_rest(examine(*roomy, test, fit, out.after.noise));
  if (choices.size() > 1 && !all_needed(nominal.set, out))
    out.excess = std::numeric_limits<double>::infinity();
  if (out.tolerable()) {
    // Many small traces in one equation that no window and no candidate has alone.
    out.after.lone = inference::strongest_lone_input(out.after.problem, out.after.noise.model);
    out.excess = std::max(out.excess, std::log(WeighLimits::quiet_p / out.after.lone.p_value));
  }
  out.log_bayes = out.after.log_evidence() - nominal.log_evidence() - log_tries(nominal, choices) -
                  narrowed + gain_of_sizes(nominal.set, out);
  return out;
}

}  // namespace drift::search
