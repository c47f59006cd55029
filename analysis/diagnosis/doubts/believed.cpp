#include "analysis/diagnosis/doubts/believed.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "analysis/diagnosis/doubts/wrong_priors.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/search/scores/log_sum.hpp"

namespace drift::diagnosis {
namespace {

using inference::SearchLimits;

constexpr double worth_saying = 1.0 - SearchLimits::credible;

bool may_be_wrong_priors(const FilterSpec& nominal, const search::Search& found,
                         const search::Posterior& right, double alpha) {
  return found.significant || (right.consistent < SearchLimits::credible &&
                               !beyond_prior(nominal, found.nominal, alpha));
}

/// The noise where nothing but noise is there.
std::vector<inference::NoiseFinding> noise_alone_in(const search::Search& found) {
  return found.noise_alone ? found.noise_alone->findings : found.nominal.noise.findings;
}

std::vector<std::size_t> parameters_of(const remark::BeyondPrior& beyond) {
  std::vector<std::size_t> all;
  for (const remark::BeyondPrior::Parameter& p : beyond.parameters) all.push_back(p.estimate.param);
  return all;
}

/// Takes explanations that name the same causes over from the other way round: these are missing
/// whichever priors are right.
void share(search::Evidence& told, const search::Search& found, search::Evidence& other,
           const search::Search& there) {
  const auto labels = [](const search::Search& s, const search::Explanation& choices) {
    std::vector<std::string> all;
    for (const NamedEffect& e : named_effects(s, choices)) all.push_back(e.label);
    std::ranges::sort(all);
    return all;
  };
  for (search::Evidence::Weighed& w : told.library)
    std::erase_if(other.library, [&](const search::Evidence::Weighed& o) {
      const bool same = labels(found, w.choices) == labels(there, o.choices);
      if (same) w.log_weight = search::log_sum(w.log_weight, o.log_weight);
      return same;
    });
}

/// What an evidence says, as parts of a probability.
Probabilities parts_of(const search::Search& found, const search::Evidence& e, double whole) {
  const search::Posterior p = search::posterior_of(e);
  Probabilities out{whole * p.consistent, whole * p.noise_only, whole * p.outside, {}, 0.0, whole};
  for (const auto& [choices, probability] : p.named)
    out.named.push_back({named_effects(found, choices), whole * probability, true});
  return out;
}

/// What would be missing the other way round; nothing where that is not credible.
std::optional<remark::OtherPriors> other_priors(const remark::BeyondPrior& beyond,
                                                remark::OtherPriors::Are are,
                                                const Probabilities& p) {
  if (p.other_priors <= worth_saying) return std::nullopt;
  remark::OtherPriors out{are, parameters_of(beyond), {}, p.other_priors};
  if (!p.named.empty() && p.named.front().probability > p.outside)
    out.effects = p.named.front().causes;
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
  search::Evidence right = search::evidence_of(found);
  search::Posterior posterior = search::posterior_of(right);
  const double all_right = search::log_total(right);
  std::optional<WrongPriors> wrong;
  if (may_be_wrong_priors(nominal, found, posterior, options.alpha))
    wrong = wrong_priors(nominal, test, fit, found, all_right, options);
  Believed out{nominal,      false,        std::move(found), std::move(posterior),
               std::nullopt, std::nullopt, std::nullopt,     {}};
  if (!wrong) return out;

  right.wrong_priors = search::log_sum(wrong->evidence.declared, wrong->evidence.estimated);
  if (wrong->beyond.explains) {
    out.posterior = search::posterior_of(right);
    if (out.posterior.wrong_priors <= worth_saying) return out;
    out.instead = std::move(wrong->beyond);
    out.instead->noise_beside = out.posterior.wrong_priors > out.posterior.noise_only;
    if (out.instead->noise_beside)
      out.with_room = {std::move(wrong->filter), noise_alone_in(wrong->found)};
    return out;
  }
  // Where something is missing that no effect describes, either way, the study is taken at its
  // word.
  if (wrong->found.sets.empty()) return out;
  if (search::log_total(wrong->evidence) <= all_right) {
    share(right, out.found, wrong->evidence, wrong->found);
    // That nothing is missing but priors are wrong is listed by itself.
    wrong->evidence.declared = wrong->evidence.estimated = search::never;
    right.other_priors = search::log_total(wrong->evidence);
    out.posterior = search::posterior_of(right);
    out.other_way = parts_of(wrong->found, wrong->evidence, out.posterior.other_priors);
    out.other = other_priors(wrong->beyond, Are::wrong, out.other_way);
    return out;
  }
  right.wrong_priors = search::never;
  share(wrong->evidence, wrong->found, right, out.found);
  wrong->evidence.other_priors = search::log_total(right);
  out.posterior = search::posterior_of(wrong->evidence);
  out.other_way = parts_of(out.found, right, out.posterior.other_priors);
  out.other = other_priors(wrong->beyond, Are::right, out.other_way);
  out.nominal = std::move(wrong->filter);
  out.wrong_priors = true;
  out.found = std::move(wrong->found);
  return out;
}

}  // namespace drift::diagnosis
