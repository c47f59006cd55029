#include "analysis/search/other_equation.hpp"

#include <algorithm>
#include <limits>

#include "analysis/inference/misalignments.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/search/promising.hpp"
#include "analysis/search/settle_noise.hpp"
#include "core/estimate/closure/closure_posterior.hpp"

namespace drift::search {
namespace {

using inference::EffortLimits;
using inference::ReachLimits;

/// The same candidate at the same setting in another list, if it has it.
std::optional<Choice> same_choice(const inference::CandidateSet& in, const inference::Candidate& c,
                                  std::size_t variant) {
  for (std::size_t k = 0; k < in.candidates.size(); ++k) {
    const inference::Candidate& other = in.candidates[k];
    if (other.term != c.term || other.params != c.params) continue;
    for (std::size_t v = 0; v < other.variants.size(); ++v)
      if (other.variants[v].settings == c.variants[variant].settings) return Choice{k, v};
  }
  return {};
}

std::optional<Choice> change_of_equation(const inference::CandidateSet& set) {
  for (std::size_t k = 0; k < set.candidates.size(); ++k)
    if (set.candidates[k].term == closure_term) return Choice{k, 0};
  return {};
}

}  // namespace

std::optional<OtherEquation> fit_other_equation(const Fitted& nominal, const MeasuredTest& test) {
  if (!facts(nominal.filter.coupling).other) return std::nullopt;
  OtherEquation out{nominal.filter, {}, -std::numeric_limits<double>::infinity()};
  out.filter.coupling = *facts(nominal.filter.coupling).other;
  const auto here = theta_of(nominal.filter, nominal.fit);
  const double here_log2 = nominal.log_likelihood2() + 2.0 * nominal.log_gain_of_misalignments();
  const auto gain_under = [&](const inference::LinearProblem& problem,
                              const inference::NoiseModel& noise) {
    const inference::Projector there(problem, noise);
    return there.marginal().log_likelihood2() +
           2.0 * inference::log_gain_of_misalignments(make_layout(out.filter), there) - here_log2;
  };
  for (const Theta& start : {here, make_layout(out.filter).theta}) {
    BatchResult fit = fit_batch_from(out.filter, test, start, nominal.fit.psi0_l);
    if (std::isfinite(out.gain) && ended_at_one_point(fit, out.fit)) continue;
    inference::LinearProblem problem = inference::linear_problem(out.filter, test, fit, {});
    problem.weight = nominal.problem.weight;
    double gain = gain_under(problem, nominal.noise.model);
    if (nominal.noise.driven) {  // by what a wrong equation leaves, perhaps
      const auto own = inference::estimate_noise(problem, declared_noise(out.filter));
      gain = std::max(
          gain, gain_under(problem, own.model) + 2.0 * (own.log_price - nominal.noise.log_price));
    }
    if (gain > out.gain) {
      out.gain = gain;
      out.fit = std::move(fit);
    }
  }
  return out;
}

std::vector<BesideEquation> beside_other_equation(const Search& s, const MeasuredTest& test,
                                                  const inference::NoiseEstimate* noise) {
  std::vector<BesideEquation> pairs;
  const auto changed = change_of_equation(s.nominal.set);
  const auto& other = s.other;
  if (!changed || !other) return pairs;
  Fitted there = noise != nullptr ? examine(other->filter, test, other->fit, *noise)
                                  : examine(other->filter, test, other->fit);
  if (const auto settled = noise != nullptr ? std::nullopt : settle_noise(there))
    there = with_noise(std::move(there), test.timeline, settled->noise);
  const double equation = there.log_evidence() + there.log_gain_of_misalignments() -
                          s.nominal.log_evidence() - s.nominal.log_gain_of_misalignments();
  const auto order = there.by_evidence();
  QuietTest left(there, ReachLimits::slack * s.thresholds.library_threshold,
                 ReachLimits::slack * s.thresholds.scan_threshold);
  for (std::size_t i = 0; i < std::min(EffortLimits::beside_asked, order.size()) &&
                          pairs.size() < EffortLimits::beside;
       ++i) {
    if (there.set.candidates[order[i]].term == closure_term) continue;  // is changed already
    const std::size_t variant = there.scores[order[i]].variant;
    const auto cause = same_choice(s.nominal.set, there.set.candidates[order[i]], variant);
    if (cause && left.quiet_beside({{order[i], variant}}))
      pairs.push_back({{*changed, *cause}, equation + there.scores[order[i]].log_bayes});
  }
  return pairs;
}

}  // namespace drift::search
