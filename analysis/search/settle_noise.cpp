#include "analysis/search/settle_noise.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <map>
#include <numeric>

#include "analysis/inference/evidence.hpp"
#include "analysis/inference/noise_doubt.hpp"

namespace drift::search {
namespace {

/// Chance below which noise of all instruments is not believed: together (they overlap) one in ten,
/// where the chances themselves are drawn with room (noise_doubt.hpp): of 51 blind nulls with such
/// noise one was doubted at half.
constexpr double no_noise = 0.08, no_noise_lone = 0.045;

/// log det (1 + C) of some columns under a noise: what a unit prior on their amplitudes costs twice
/// the log of the marginal likelihood against its maximum.
double price(const inference::LinearProblem& problem, const inference::NoiseModel& noise,
             const std::vector<int>& columns) {
  inference::LinearProblem part = problem;
  part.extra = problem.extra(Eigen::all, columns);
  const MatX C = inference::Projector(part, noise).candidates().C +
                 MatX::Identity(part.extra.cols(), part.extra.cols());
  const MatX L = Eigen::LLT<MatX>(C).matrixL();
  return 2.0 * L.diagonal().array().log().sum();
}

/// A noise with what drives the platform made smaller.
inference::NoiseModel weaker(inference::NoiseModel m, double factor) {
  for (double* s : {&m.angle_random_walk, &m.drift_random_walk, &m.markov_drift, &m.acc_markov})
    *s *= factor;
  return m;
}

/// Strength of an effect in the mean that is worth having there once noise is not believed.
constexpr double chance = 2.0;

struct Try {
  std::size_t candidate = 0, variant = 0;
  double ratio = 0.0, strength = 0.0;
};

/// Candidates by their likelihood ratio against `reference`, best over several noises.
std::vector<Try> tries_under(const Examination& e, const std::vector<inference::NoiseModel>& views,
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

}  // namespace

std::vector<std::size_t> by_evidence(const Examination& e) {
  std::vector<std::size_t> order(e.scores.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return e.scores[a].log_bayes > e.scores[b].log_bayes;
  });
  std::erase_if(order, [&](std::size_t k) { return e.scores[k].dof == 0; });
  return order;
}

bool settle_noise(Examination& e, const inference::Test& test, double threshold,
                  std::size_t most_tries, int rounds) {
  const inference::NoiseModel declared = declared_noise(e.filter);
  inference::NoiseEstimate now = e.noise;
  std::vector<int> in_mean;
  bool replaced = false;
  for (int round = 0; round < rounds && now.driven; ++round) {
    const inference::NoiseEstimate white =
        inference::estimate_noise(e.problem, declared, in_mean, 0);
    const inference::LoneEffect lone =
        inference::strongest_lone_input(e.problem, white.model, in_mean);
    const inference::NoiseDoubt d =
        inference::doubt(e.problem, e.set, white.model, now.model, lone, in_mean);
    if (d.p_lone <= no_noise_lone && white.log_likelihood2 + lone.gain > now.log_likelihood2) {
      // The white noise that is left beside it; the input itself is no noise and is left to be
      // explained.
      inference::NoiseModel with_lone = white.model;
      with_lone.lone = lone.input;
      now = inference::estimate_noise(e.problem, with_lone, in_mean, 0);
      now.model.lone = {};
      replaced = true;
      break;
    }
    const bool no_such_noise = d.p_candidate <= no_noise;
    std::vector<inference::NoiseModel> views{white.model};
    if (!no_such_noise) views.insert(views.end(), {weaker(now.model, 0.3), now.model});
    std::vector<Try> tries =
        tries_under(e, views, no_such_noise ? white.log_likelihood2 : now.log_likelihood2, in_mean);
    if (tries.size() > most_tries) tries.resize(most_tries);
    inference::NoiseEstimate best;
    double strongest = 0.0;
    std::vector<int> best_mean;
    for (const Try& t : tries) {
      const auto& columns = e.set.candidates[t.candidate].variants[t.variant].columns;
      std::vector<int> mean = in_mean;
      mean.insert(mean.end(), columns.begin(), columns.end());
      const inference::NoiseEstimate with = inference::estimate_noise(e.problem, declared, mean);
      const double ratio =
          with.log_likelihood2 - now.log_likelihood2 + price(e.problem, with.model, columns);
      const double s = stats::strength(ratio, static_cast<int>(columns.size()));
      if (s <= strongest) continue;
      strongest = s;
      best = with;
      best_mean = mean;
    }
    if (strongest < (no_such_noise ? chance : threshold)) break;
    now = best;
    in_mean = best_mean;
    replaced = true;
  }
  if (replaced) set_noise(e, test.timeline, now);
  return replaced;
}

}  // namespace drift::search
