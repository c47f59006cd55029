#include "analysis/search/settle_noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "analysis/inference/marginal.hpp"
#include "analysis/inference/noise/noise_component.hpp"
#include "analysis/inference/size_prior.hpp"
#include "analysis/search/scores/library_prior.hpp"
#include "analysis/search/scores/log_sum.hpp"
#include "analysis/search/settings_alike.hpp"
#include "analysis/search/unknown_input.hpp"
#include "mc/task/campaign.hpp"

namespace drift::search {
namespace {

using inference::EffortLimits;
using inference::NoiseEstimate;
using inference::PosteriorPrior;

/// Candidates in the mean and a noise.
struct Model {
  Explanation in;
  NoiseEstimate noise;
  double log_weight = never;  ///< prior times evidence
};

/// Change of the log evidence where amplitudes, in the mean with unit priors, are of unknown size.
double gain_of_sizes_in(const Fitted& e, const Explanation& in, const NoiseEstimate& noise) {
  if (in.empty()) return 0.0;
  const inference::LinearProblem with = e.problem.with_mean_alone(distinct_columns_of(e.set, in));
  const inference::Projector::Fit fit = inference::Projector(with, noise.model).fit();
  const Eigen::Index first = e.problem.theta.cols(), n = with.theta.cols() - first;
  std::vector<int> cause;
  for (const int column : distinct_columns_of(e.set, in)) {
    const auto has = [&](const Choice& c) {
      const auto& own = e.set.candidates[c.candidate].variants[c.variant].columns;
      return std::ranges::find(own, column) != own.end();
    };
    cause.push_back(static_cast<int>(std::ranges::find_if(in, has) - in.begin()));
  }
  return inference::log_gain_of_sizes(fit.x.tail(n), fit.covariance.bottomRightCorner(n, n), cause);
}

class NoiseOrEffects {
 public:
  NoiseOrEffects(const Fitted& e, std::size_t tries)
      : e_(e), tries_(tries), declared_(declared_noise(e.filter)), prior_(e.set) {}

  /// Of what is in the mean: prior, and all settings by what they have of the evidence of this one.
  double log_prior(const Explanation& in) const {
    if (in.empty()) return std::log(PosteriorPrior::nothing);
    double sum = std::log(PosteriorPrior::library) + prior_.log_of(in);
    for (const Choice& c : in) sum += log_settings_.at({c.candidate, c.variant});
    return sum;
  }

  Model weighed(Explanation in, NoiseEstimate noise) {
    Model m{std::move(in), std::move(noise), never};
    m.log_weight = log_prior(m.in) + gain_of_sizes_in(e_, m.in, m.noise) + m.noise.log_evidence();
    if (!m.in.empty()) remember(m.in, m.log_weight);
    return m;
  }
  std::vector<int> columns(const Explanation& in) const { return distinct_columns_of(e_.set, in); }
  Model white(Explanation in) {
    if (const Model* m = met(white_, in)) return *m;
    NoiseEstimate noise = inference::estimate_noise(e_.problem, declared_, columns(in), 0);
    return white_.emplace_back(weighed(std::move(in), std::move(noise)));
  }
  /// With the noise that the nominal model needs, or what is left of it.
  Model driven(Explanation in) {
    if (const Model* m = met(driven_, in)) return *m;
    NoiseEstimate noise =
        inference::estimate_noise_from(e_.problem, declared_, e_.noise, columns(in));
    return driven_.emplace_back(weighed(std::move(in), std::move(noise)));
  }

  /// White noise with candidates added one after the other as long as that gains.
  Model white_with_candidates() {
    Model now = white({});
    while (now.in.size() < EffortLimits::together) {
      std::optional<Model> best = best_white(additions(now));
      if (!best || best->log_weight <= now.log_weight) break;
      now = std::move(*best);
    }
    return now;
  }
  Model from_white() { return driven(white_with_candidates().in); }

  /// The weight of a model, or less, by a few evaluations: the best of white noise and of `noise`
  /// with what drives the platform in it at some shares of its size. An estimate takes a hundred.
  double glimpse(const Explanation& in, const NoiseEstimate& noise) const {
    const Model* m = met(white_, in);
    const double of_white = m != nullptr ? m->log_weight : never;
    const inference::MarginalLikelihood rows(e_.problem, columns(in));
    NoiseEstimate best = noise;
    best.log_likelihood2 = never;
    for (const double share : {1.0, 0.3, 0.1}) {
      inference::NoiseModel model = noise.model;
      for (const inference::NoiseComponent* c : noise.components)
        if (!c->white()) model.*(c->sigma) *= share;
      if (const double l = rows.log_likelihood2(model); l > best.log_likelihood2) {
        best.model = model;
        best.log_likelihood2 = l;
      }
    }
    return std::max(of_white, log_prior(in) + gain_of_sizes_in(e_, in, best) + best.log_evidence());
  }

  /// The best of these with driven noise. Noises are estimated in the order of glimpses, a few at
  /// least, until one falls short of the best by more than twice what any did of its estimate.
  std::optional<Model> best_driven(const std::vector<Explanation>& all,
                                   const NoiseEstimate& noise) {
    for (const Explanation& in : all) white(in);
    const std::vector<double> glimpses =
        mc::run_campaign(all.size(), [&](std::size_t k) { return glimpse(all[k], noise); });
    std::vector<std::size_t> order(all.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater{}, [&](std::size_t k) { return glimpses[k]; });
    std::optional<Model> best;
    double short_by = 0.0;
    for (std::size_t k = 0; k < order.size(); ++k) {
      const Explanation& in = all[order[k]];
      const double seen = glimpses[order[k]];
      if (k >= EffortLimits::noises && seen + 2.0 * short_by < best->log_weight) {
        remember(in, seen);
        continue;
      }
      Model m = driven(in);
      short_by = std::max(short_by, m.log_weight - seen);
      if (!best || m.log_weight > best->log_weight) best = std::move(m);
    }
    return best;
  }

  /// One candidate added, dropped or swapped at a time as long as that gains.
  Model climbed(Model now) {
    for (std::size_t step = 0; step < EffortLimits::together; ++step) {
      std::vector<Explanation> more;
      if (now.in.size() < EffortLimits::together) more = additions(now);
      for (std::size_t k = 0; k < now.in.size(); ++k) {
        Explanation fewer = now.in;
        fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
        if (!fewer.empty()) more.push_back(fewer);
        // Driven noise would hide what it stands for.
        for (Explanation& swapped : additions(white(fewer))) more.push_back(std::move(swapped));
      }
      std::erase_if(more, [&](const Explanation& x) { return same(x, now.in); });
      std::optional<Model> best = best_driven(more, now.noise.driven ? now.noise : e_.noise);
      if (!best || best->log_weight <= now.log_weight) break;
      now = std::move(*best);
    }
    return now;
  }

  /// Log of the sum of the weights of all models with candidates that were met.
  double log_sum_of_effects() const {
    if (met_.empty()) return never;
    double top = never, sum = 0.0;
    for (const auto& [in, log_weight] : met_) top = std::max(top, log_weight);
    for (const auto& [in, log_weight] : met_) sum += std::exp(log_weight - top);
    return top + std::log(sum);
  }

 private:
  /// Causes count once, with the better of their noises and settings.
  void remember(const Explanation& in, double log_weight) {
    const auto at =
        std::ranges::find_if(met_, [&](const auto& other) { return same_causes(other.first, in); });
    if (at == met_.end())
      met_.emplace_back(in, log_weight);
    else
      at->second = std::max(at->second, log_weight);
  }

  static const Model* met(const std::vector<Model>& all, const Explanation& in) {
    const auto at = std::ranges::find_if(all, [&](const Model& m) { return same(m.in, in); });
    return at == all.end() ? nullptr : &*at;
  }

  /// With the candidate, each at its best setting, that gains most by the linearised test under the
  /// noise of a model, and the next best.
  std::vector<Explanation> additions(const Model& m) {
    struct Try {
      Choice choice;
      double gain;
    };
    const inference::Projector projector(e_.problem.with_mean(distinct_columns_of(e_.set, m.in)),
                                         m.noise.model);
    std::vector<Try> all;
    for (std::size_t k = 0; k < e_.set.candidates.size(); ++k) {
      const inference::Candidate& c = e_.set.candidates[k];
      if (of_a_chosen_family(e_.set, m.in, c) || c.term == closure_term) continue;
      const BestSetting best = best_setting(e_.set, projector, k);
      const Choice choice{k, best.variant};
      log_settings_.try_emplace({k, best.variant}, best.log_all_against_this);
      all.push_back({choice, best.log_evidence + prior_.log_of({choice})});
    }
    std::ranges::stable_sort(all, std::greater{}, &Try::gain);
    std::vector<Explanation> out;
    std::set<std::pair<std::string, std::string>> seen;  // one of each name
    for (const Try& t : all) {
      const inference::Candidate& c = e_.set.candidates[t.choice.candidate];
      if (out.size() == tries_ || !std::isfinite(t.gain)) break;
      if (!seen.insert({c.term, c.axis}).second) continue;
      out.push_back(m.in);
      out.back().push_back(t.choice);
    }
    return out;
  }

  std::optional<Model> best_white(const std::vector<Explanation>& all) {
    std::optional<Model> best;
    for (const Explanation& in : all)
      if (Model m = white(in); !best || m.log_weight > best->log_weight) best = std::move(m);
    return best;
  }

  const Fitted& e_;
  std::size_t tries_;
  inference::NoiseModel declared_;
  LibraryPrior prior_;
  /// Of candidates and settings: log evidence over all settings against that of this one, under
  /// the noise with which it was first seen.
  std::map<std::pair<std::size_t, std::size_t>, double> log_settings_;
  std::vector<Model> white_, driven_;  ///< estimated already
  std::vector<std::pair<Explanation, double>> met_;
};

/// Models of a test and what their weights sum up to, as logs.
struct Competition {
  Model best;
  double alone = never, effects = never;
  WithInput with;
  double input = never;

  double of_all() const { return log_sum(log_sum(alone, effects), input); }
};

Competition compete(const Fitted& e, std::size_t tries, UnknownInputs inputs) {
  NoiseOrEffects models(e, tries);
  const Model alone{{}, e.noise, models.log_prior({}) + e.noise.log_evidence()};
  Model best = models.from_white();
  for (const Model& begin : {best, alone})
    if (Model m = models.climbed(begin);
        !m.in.empty() && (best.in.empty() || m.log_weight > best.log_weight))
      best = std::move(m);
  WithInput with = with_input(e, models.white({}).noise, inputs);
  const double of_input = std::log(PosteriorPrior::outside) + with.log_evidence;
  return {std::move(best), alone.log_weight, models.log_sum_of_effects(), std::move(with),
          of_input};
}

}  // namespace

std::optional<NoiseSettled> settle_noise(const Fitted& e, std::size_t tries, UnknownInputs inputs) {
  if (!e.noise.driven) return std::nullopt;
  Competition c = compete(e, tries, inputs);
  const double p = std::exp(c.alone - c.of_all());
  if (p > inference::SearchLimits::credible) return std::nullopt;
  if (c.input > c.effects) return NoiseSettled{c.with.noise, 1.0 - p};
  if (c.best.in.empty()) return std::nullopt;
  return NoiseSettled{std::move(c.best.noise), 1.0 - p};
}

std::optional<NoiseEstimate> drift_of_cagings(const Fitted& e) {
  using inference::SearchLimits;
  NoiseEstimate differing = inference::estimate_noise(e.problem, declared_noise(e.filter), {},
                                                      inference::NoiseLimits::most_components,
                                                      inference::Cagings::may_differ);
  if (!inference::caging_drift.in(differing.model)) return std::nullopt;
  constexpr std::size_t tries = EffortLimits::noise_tries;
  const double odds = std::log(SearchLimits::credible / (1.0 - SearchLimits::credible));
  const double weight = std::log(PosteriorPrior::nothing) + differing.log_evidence();
  // Most often white noise and a few candidates are enough to say no.
  const auto loses_to = [&](double others) { return weight - others < odds; };
  if (loses_to(std::log(PosteriorPrior::nothing) + e.noise.log_evidence()) ||
      loses_to(NoiseOrEffects(e, tries).white_with_candidates().log_weight) ||
      loses_to(compete(e, tries, UnknownInputs::periodic_too).of_all()))
    return std::nullopt;
  return differing;
}

}  // namespace drift::search
