#include "analysis/search/posterior.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/inference/size_prior.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/search/by_noise.hpp"
#include "analysis/search/scores/library_prior.hpp"
#include "analysis/search/scores/log_sum.hpp"

namespace drift::search {
namespace {

using inference::PosteriorPrior;
using inference::WeighLimits;

bool can_be_seen(const Fitted& e, std::size_t candidate) {
  return e.scores[candidate].visible > 0.0;
}

/// What an evidence over all sizes says of those that the test could see.
double log_of_visible(const Fitted& e, const Explanation& choices) {
  double sum = 0.0;
  for (const Choice& c : choices)
    if (can_be_seen(e, c.candidate)) sum -= std::log(e.scores[c.candidate].visible);
  return sum;
}

/// Single candidates, linearised.
std::vector<Evidence::Weighed> singles(const Fitted& e, const LibraryPrior& prior, double base) {
  std::vector<Evidence::Weighed> all;
  for (std::size_t k = 0; k < e.scores.size(); ++k)
    if (e.scores[k].visible > 0.0) {
      const Explanation one{{k, e.scores[k].variant}};
      all.push_back({one, base + prior.log_of(one) + e.scores[k].log_bayes_visible});
    }
  return all;
}

/// Fitted explanations, each with the noise that suits it.
double log_evidence(const Search& found, const Refit& r, const inference::NoiseModel& declared) {
  const ByNoise noise = by_noise(r.after, declared);
  // log_bayes compares the two models under the noise estimated for each.
  return r.log_bayes - (r.after.log_evidence() - found.nominal.log_evidence()) + noise.either();
}

/// Those of the credible set and what stands beside it, which share their evidence as it weighs
/// them: members of a family count together there.
std::vector<Evidence::Weighed> explanations(const Search& found, const LibraryPrior& prior,
                                            const inference::NoiseModel& declared) {
  std::vector<Evidence::Weighed> all;
  double evidence = never, share = 0.0;
  const bool outweighed = found.sets.empty();
  const std::vector<Refit>& sets = outweighed ? found.outweighed : found.sets;
  const std::vector<double>& probability =
      outweighed ? found.outweighed_probability : found.probability;
  for (std::size_t k = 0; k < sets.size(); ++k) {
    const Refit& r = sets[k];
    evidence =
        log_sum(evidence, log_evidence(found, r, declared) + prior.log_of(r.choices) +
                              log_of_visible(found.nominal, r.choices) - std::max(0.0, r.excess));
    share += probability[k];
  }
  for (std::size_t k = 0; k < sets.size(); ++k)
    all.push_back({sets[k].choices, evidence + std::log(probability[k] / share)});
  for (const Unlisted& other : found.unlisted)
    all.push_back({other.choices, evidence + std::log(other.probability / share)});
  return all;
}

/// Something in one window, one of all.
double log_window(const Fitted& e) {
  double sum = never, windows = 0.0;
  for (const inference::PositionScan& scan : e.scans)
    for (const double T : scan.T) {
      if (T <= 0.0) continue;
      sum = log_sum(sum, inference::log_evidence_of_unknown_size(T));
      windows += 1.0;
    }
  return windows > 0.0 ? sum - std::log(windows) : never;
}

/// Something outside the library, beside nothing or beside the best that the library offers.
double log_outside(const Search& found, const LibraryPrior& prior,
                   const inference::NoiseModel& declared, const ByNoise& nothing) {
  const Fitted& e = found.nominal;
  // Its gain is against the estimated noise, which is not at its best where the misfit is gross.
  const double alone = std::min(nothing.either(), 0.5 * e.log_likelihood2()) +
                       std::max({log_free_form(e.unknown->lone, e.problem),
                                 e.unknown->periodic.log_evidence(), log_window(e)});
  const std::vector<Refit>& fitted = !found.sets.empty()         ? found.sets
                                     : !found.outweighed.empty() ? found.outweighed
                                                                 : found.rejected;
  const Refit* best = nullptr;
  for (const Refit& r : fitted)
    if (!best || r.log_bayes > best->log_bayes) best = &r;
  if (!best) return std::max(alone, found.log_form);
  const Fitted& left = best->after;
  const StrongestInputs unknown = left.strongest_inputs();
  const double beside_a_cause =
      log_evidence(found, *best, declared) + prior.log_of(best->choices) +
      log_of_visible(found.nominal, best->choices) - std::log(WeighLimits::outside_too) +
      std::max(log_free_form(unknown.lone, left.problem), unknown.periodic.log_evidence());
  return std::max({alone, found.log_form, beside_a_cause});
}

/// All that an evidence lists where something is missing.
double log_of_missing(const Evidence& e) {
  double total = std::log(PosteriorPrior::outside) + e.outside;
  for (const Evidence::Weighed& w : e.library)
    total = log_sum(total, std::log(PosteriorPrior::library) + w.log_weight);
  return total;
}

}  // namespace

double log_total(const Evidence& e) {
  const double nothing = log_sum(log_sum(e.declared, e.estimated), e.wrong_priors);
  return log_sum(log_sum(std::log(PosteriorPrior::nothing) + nothing, e.other_priors),
                 log_of_missing(e));
}

Posterior posterior_of(const Evidence& e) {
  const double declared = std::log(PosteriorPrior::nothing) + e.declared,
               estimated = std::log(PosteriorPrior::nothing) + e.estimated,
               outside = std::log(PosteriorPrior::outside) + e.outside,
               wrong = std::log(PosteriorPrior::nothing) + e.wrong_priors,
               library = std::log(PosteriorPrior::library), total = log_total(e);
  Posterior out;
  out.consistent = std::exp(declared - total);
  out.noise_only = std::exp(estimated - total);
  out.outside = std::exp(outside - total);
  out.wrong_priors = std::exp(wrong - total);
  out.other_priors = std::exp(e.other_priors - total);
  for (const Evidence::Weighed& w : e.library)
    if (const double p = std::exp(library + w.log_weight - total); p >= PosteriorPrior::listed)
      out.named.push_back({w.choices, p});
  std::ranges::stable_sort(out.named, std::greater{}, &Posterior::Explained::probability);
  double sum = out.consistent + out.noise_only + out.outside + out.wrong_priors + out.other_priors;
  for (const auto& n : out.named) sum += n.probability;
  out.consistent /= sum;
  out.noise_only /= sum;
  out.outside /= sum;
  out.wrong_priors /= sum;
  out.other_priors /= sum;
  for (auto& n : out.named) n.probability /= sum;
  return out;
}

Evidence evidence_of(const Search& found) {
  const Fitted& e = found.nominal;
  const inference::NoiseModel declared = declared_noise(e.filter);
  const ByNoise nothing = by_noise(found, declared);
  const LibraryPrior prior(e.set, [&](std::size_t k) { return can_be_seen(e, k); });
  return {nothing.declared, nothing.estimated, log_outside(found, prior, declared, nothing),
          found.significant ? explanations(found, prior, declared)
                            : singles(e, prior, nothing.either())};
}

}  // namespace drift::search
