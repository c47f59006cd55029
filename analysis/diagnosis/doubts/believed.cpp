#include "analysis/diagnosis/doubts/believed.hpp"

#include <cmath>
#include <utility>

#include "analysis/diagnosis/doubts/wrong_priors.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/search/scores/log_sum.hpp"

namespace drift::diagnosis {
namespace {

using inference::SearchLimits;

bool may_be_wrong_priors(const FilterSpec& nominal, const search::Search& found,
                         const search::Posterior& right, double alpha) {
  return found.significant || (right.consistent < SearchLimits::credible &&
                               !beyond_prior(nominal, found.nominal, alpha));
}

std::vector<std::size_t> parameters_of(const remark::BeyondPrior& beyond) {
  std::vector<std::size_t> all;
  for (const remark::BeyondPrior::Parameter& p : beyond.parameters) all.push_back(p.estimate.param);
  return all;
}

/// What would be missing the other way round.
remark::OtherPriors other_priors(const remark::BeyondPrior& beyond, remark::OtherPriors::Are are,
                                 const search::Search& found, const search::Posterior& posterior,
                                 double probability) {
  remark::OtherPriors out{are, parameters_of(beyond), {}, probability};
  if (!posterior.named.empty() && posterior.named.front().probability > posterior.outside)
    out.effects = named_effects(found, posterior.named.front().choices);
  return out;
}

}  // namespace

std::vector<NamedEffect> named_effects(const search::Search& found,
                                       const search::Explanation& choices) {
  std::vector<NamedEffect> all;
  for (const search::Choice& choice : choices) {
    const inference::Candidate& c = found.nominal.set.candidates[choice.candidate];
    all.push_back({c.term, c.axis, c.label});
  }
  return all;
}

Believed believed(const FilterSpec& nominal, const MeasuredTest& test, const BatchResult& fit,
                  search::Search found, const search::SearchOptions& options) {
  using Are = remark::OtherPriors::Are;
  constexpr double worth_saying = 1.0 - SearchLimits::credible;
  search::Evidence right = search::evidence_of(found);
  search::Posterior posterior = search::posterior_of(right);
  const double all_right = search::log_total(right);
  std::optional<WrongPriors> wrong;
  if (may_be_wrong_priors(nominal, found, posterior, options.alpha))
    wrong = wrong_priors(nominal, test, fit, found, all_right, options);
  Believed out{nominal, false, std::move(found), std::move(posterior), std::nullopt, std::nullopt};
  if (!wrong) return out;

  right.wrong_priors = search::log_sum(wrong->evidence.declared, wrong->evidence.estimated);
  if (wrong->beyond.explains) {
    out.posterior = search::posterior_of(right);
    if (out.posterior.wrong_priors > worth_saying) out.instead = std::move(wrong->beyond);
    return out;
  }
  if (search::log_total(wrong->evidence) <= all_right) {
    right.other_priors = search::log_of_missing(wrong->evidence);
    out.posterior = search::posterior_of(right);
    if (out.posterior.other_priors > worth_saying)
      out.other = other_priors(wrong->beyond, Are::wrong, wrong->found,
                               search::posterior_of(wrong->evidence), out.posterior.other_priors);
    return out;
  }
  wrong->evidence.other_priors = all_right;
  const search::Posterior of_wrong = search::posterior_of(wrong->evidence);
  if (of_wrong.other_priors > worth_saying)
    out.other =
        other_priors(wrong->beyond, Are::right, out.found, out.posterior, of_wrong.other_priors);
  out.nominal = std::move(wrong->filter);
  out.wrong_priors = true;
  out.found = std::move(wrong->found);
  out.posterior = of_wrong;
  return out;
}

}  // namespace drift::diagnosis
