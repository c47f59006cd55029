#include "analysis/inference/noise/noise_doubt.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/inference/projector.hpp"
#include "analysis/inference/thresholds.hpp"
#include "core/base/decompose.hpp"
#include "core/base/rng.hpp"
#include "core/base/units.hpp"
#include "core/stats/normal.hpp"

namespace drift::inference {
namespace {

constexpr int draws = 250;
constexpr std::uint64_t doubt_seed =
    19610411;  // any number: fixed, so that a diagnosis is repeatable

/// Recordings, one per column: the first is the real one, the others are drawn with the noise and
/// parameters from their prior.
MatX recordings(const LinearProblem& problem, const Whitener& noise) {
  Stream random(doubt_seed, 0, Purpose::design);
  const auto normal = [&](Eigen::Index rows) {
    MatX m(rows, draws);
    for (Eigen::Index k = 0; k < m.size(); ++k) m.data()[k] = random.normal();
    return m;
  };
  MatX all(problem.rows(), draws + 1);
  all.col(0) = problem.r0;
  all.rightCols(draws) = noise.colour(normal(problem.rows()));
  all.rightCols(draws).noalias() += problem.theta * normal(problem.theta.cols());
  return all;
}

/// What the candidate that suits each recording best gains in its mean, of twice the log
/// likelihood, less the price of its amplitudes.
VecX best_gain(const Projector& projector, const CandidateSet& set, const MatX& g) {
  VecX best = VecX::Zero(g.cols());
  for (const Candidate& c : set.candidates) {
    if (c.params.size() > NoiseDoubtLimits::most_params) continue;
    for (const Variant& v : c.variants) {
      const auto n = static_cast<Eigen::Index>(v.columns.size());
      const MatX C = projector.candidates(v.columns).C + MatX::Identity(n, n);
      const MatX part = Cholesky(C).halved(g(v.columns, Eigen::all));
      best = best.cwiseMax(
          part.colwise().squaredNorm().transpose() -
          VecX::Constant(g.cols(), NoiseDoubtLimits::per_amplitude * static_cast<double>(n - 1)));
    }
  }
  return best;
}

/// How often a drawn value reaches the first one.
double p_of(const VecX& value) {
  const auto above = (value.tail(draws).array() >= value[0]).count();
  return (1.0 + static_cast<double>(above)) / (1.0 + draws);
}

/// Chance that such noise, if there is any, is so small: log-normal about the sizes that gyros have
/// (physics.md 4, effects 8, 9 and 11: the ranges are one sigma to either side), and about half the
/// white noise of an accelerometer. Of several components the one most like noise counts. Never
/// less than two sigma say: better instruments than the usual ones exist.
double p_of_size(const LinearProblem& problem, const NoiseModel& white, const NoiseModel& driven) {
  struct Usual {
    double NoiseModel::*sigma;
    double low, high;  // SI
  };
  constexpr double arw = unit::deg_per_sqrt_h.to_si, walk = unit::deg_per_h_per_sqrt_h.to_si,
                   drift = unit::deg_per_h.to_si;
  const Usual usual[] = {
      {&NoiseModel::angle_random_walk, 3e-4 * arw, 3e-3 * arw},
      {&NoiseModel::drift_random_walk, 1e-3 * walk, 5e-3 * walk},
      {&NoiseModel::markov_drift, 2e-3 * drift, 1e-2 * drift},
      {&NoiseModel::acc_markov, 0.2 * problem.acc_sigma, 1.2 * problem.acc_sigma}};
  double p = stats::normal_distribution(-NoiseDoubtLimits::smallest);
  for (const Usual& u : usual) {
    const double found = driven.*(u.sigma);
    if (found <= white.*(u.sigma)) continue;  // declared, or not there
    const double middle = 0.5 * std::log(u.low * u.high), spread = 0.5 * std::log(u.high / u.low);
    p = std::max(p, stats::normal_distribution((std::log(found) - middle) / spread));
  }
  return p;
}

/// Chance that the product of two independent p-values is as small as this (Fisher).
double joint(double p, double q) {
  const double product = p * q;
  return product > 0.0 ? product * (1.0 - std::log(product)) : 0.0;
}

}  // namespace

NoiseDoubt doubt(const LinearProblem& problem, const CandidateSet& set, const NoiseModel& white,
                 const NoiseModel& driven, const LoneEffect& lone,
                 const std::vector<int>& in_mean) {
  const LinearProblem with = problem.with_mean(in_mean), bare = with.bare();
  const Projector noise(bare, driven), plain(with, white);
  const MatX drawn = recordings(bare, noise.whitener());
  const VecX as_noise = noise.replay(drawn).log_likelihood2;
  const Projector::Replay as_white = plain.replay(drawn);
  NoiseDoubt out;
  const double size = p_of_size(problem, white, driven);
  const VecX as_candidate = as_white.log_likelihood2 + best_gain(plain, set, as_white.g);
  out.p_candidate = joint(p_of(as_candidate - as_noise), size);
  if (lone.gain <= 0.0) return out;
  VecX alone = VecX::Constant(draws + 1, -1e300);
  for (int axis = 0; axis < 3; ++axis) {
    NoiseModel m = white;
    m.lone = lone.input;
    m.lone.axis = axis;
    alone = alone.cwiseMax(Projector(bare, m).replay(drawn).log_likelihood2);
  }
  out.p_lone = joint(p_of(alone - as_noise), size);
  return out;
}

}  // namespace drift::inference
