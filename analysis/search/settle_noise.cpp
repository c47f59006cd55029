#include "analysis/search/settle_noise.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/inference/evidence.hpp"
#include "analysis/inference/noise/noise_doubt.hpp"
#include "analysis/inference/thresholds.hpp"

namespace drift::search {
namespace {

using inference::NoiseDoubtLimits;

/// log det (1 + C) of some columns under a noise: what a unit prior on their amplitudes costs twice
/// the log of the marginal likelihood against its maximum.
double price(const inference::LinearProblem& problem, const inference::NoiseModel& noise,
             const std::vector<int>& columns) {
  const auto log_det = [&](const inference::LinearProblem& p) {
    return inference::marginal_of(p, noise).log_det;
  };
  return log_det(problem.with_mean(columns)) - log_det(problem);
}

/// A noise with what drives the platform made smaller.
inference::NoiseModel weaker(inference::NoiseModel m, double factor) {
  for (double* s : {&m.angle_random_walk, &m.drift_random_walk, &m.markov_drift, &m.acc_markov})
    *s *= factor;
  return m;
}

struct Try {
  std::size_t candidate = 0, variant = 0;
  double ratio = 0.0, strength = 0.0;
};

/// Candidates by their likelihood ratio against `reference`, best over several noises.
std::vector<Try> tries_under(const Fitted& e, const std::vector<inference::NoiseModel>& views,
                             double reference, const std::vector<int>& in_mean) {
  std::vector<Try> tries(e.set.candidates.size());
  for (const inference::NoiseModel& view : views) {
    const inference::Evidence seen = inference::evidence_under(e.problem, e.set, view, in_mean);
    for (std::size_t k = 0; k < tries.size(); ++k) {
      const double ratio = seen.log_likelihood2 + seen.gains[k].ratio - reference;
      if (seen.gains[k].ratio > 0.0 && ratio > tries[k].ratio)
        tries[k] = {k, seen.gains[k].variant, ratio, stats::strength(ratio, seen.gains[k].dof)};
    }
  }
  std::erase_if(tries, [&](const Try& t) {
    if (t.ratio <= 0.0) return true;
    const auto& columns = e.set.candidates[t.candidate].variants[t.variant].columns;
    return std::find(in_mean.begin(), in_mean.end(), columns.front()) != in_mean.end();
  });
  std::stable_sort(tries.begin(), tries.end(),
                   [](const Try& a, const Try& b) { return a.strength > b.strength; });
  // The same signature under several names is worth one try.
  std::vector<Try> kept;
  for (const Try& t : tries)
    if (std::none_of(kept.begin(), kept.end(),
                     [&](const Try& k) { return std::abs(k.ratio - t.ratio) < 1e-6 * t.ratio; }))
      kept.push_back(t);
  return kept;
}

/// The noise with the candidate in the mean that gains most over `now`.
struct Settled {
  inference::NoiseEstimate noise;
  std::vector<int> in_mean;
  double strength = 0.0;
};

Settled best_of(const Fitted& e, const std::vector<Try>& tries, const std::vector<int>& in_mean,
                double now) {
  Settled best;
  const inference::NoiseModel declared = declared_noise(e.filter);
  for (const Try& t : tries) {
    const auto& columns = e.set.candidates[t.candidate].variants[t.variant].columns;
    std::vector<int> mean = in_mean;
    mean.insert(mean.end(), columns.begin(), columns.end());
    inference::NoiseEstimate with = inference::estimate_noise(e.problem, declared, mean);
    const double ratio = with.log_likelihood2 - now + price(e.problem, with.model, columns);
    const double s = stats::strength(ratio, static_cast<int>(columns.size()));
    if (s > best.strength) best = {std::move(with), std::move(mean), s};
  }
  return best;
}

/// The white noise that is left beside an input in one equation; the input itself is no noise and
/// is left to be explained.
inference::NoiseEstimate beside(const Fitted& e, const inference::NoiseModel& white,
                                const inference::LoneInput& input,
                                const std::vector<int>& in_mean) {
  inference::NoiseModel with_lone = white;
  with_lone.lone = input;
  inference::NoiseEstimate left = inference::estimate_noise(e.problem, with_lone, in_mean, 0);
  left.model.lone = {};
  return left;
}

}  // namespace

std::optional<inference::NoiseEstimate> settle_noise(const Fitted& e, double threshold,
                                                     std::size_t most_tries, int rounds) {
  const inference::NoiseModel declared = declared_noise(e.filter);
  std::optional<inference::NoiseEstimate> other;
  std::vector<int> in_mean;
  for (int round = 0; round < rounds; ++round) {
    const inference::NoiseEstimate& now = other ? *other : e.noise;
    if (!now.driven) break;
    const inference::NoiseEstimate white =
        inference::estimate_noise(e.problem, declared, in_mean, 0);
    const inference::LoneEffect lone =
        inference::strongest_lone_input(e.problem, white.model, in_mean);
    const inference::NoiseDoubt d =
        inference::doubt(e.problem, e.set, white.model, now.model, lone, in_mean);
    if (d.p_lone <= NoiseDoubtLimits::lone_p &&
        white.log_likelihood2 + lone.gain > now.log_likelihood2)
      return beside(e, white.model, lone.input, in_mean);
    const bool no_such_noise = d.p_candidate <= NoiseDoubtLimits::candidate_p;
    std::vector<inference::NoiseModel> views{white.model};
    if (!no_such_noise) views.insert(views.end(), {weaker(now.model, 0.3), now.model});
    std::vector<Try> tries =
        tries_under(e, views, no_such_noise ? white.log_likelihood2 : now.log_likelihood2, in_mean);
    if (tries.size() > most_tries) tries.resize(most_tries);
    Settled best = best_of(e, tries, in_mean, now.log_likelihood2);
    if (best.strength < (no_such_noise ? NoiseDoubtLimits::worth : threshold)) break;
    other = std::move(best.noise);
    in_mean = std::move(best.in_mean);
  }
  return other;
}

}  // namespace drift::search
