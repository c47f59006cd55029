#include "analysis/inference/noise_doubt.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/inference/whitener.hpp"
#include "core/base/rng.hpp"

namespace drift::inference {
namespace {

constexpr int draws = 250;
constexpr std::uint64_t doubt_seed =
    19610411;  // any number: fixed, so that a diagnosis is repeatable
constexpr double per_degree =
    3.0;  // of twice the log likelihood: what another amplitude must bring
constexpr std::size_t most_params = 3;

/// Parameters, attitude and noise taken out of columns: what the restricted likelihood needs.
class View {
 public:
  View(const LinearProblem& problem, const MatX& theta, const NoiseModel& noise)
      : whitener_(problem, noise) {
    theta_ = whitener_.apply(theta);
    MatX A = MatX::Identity(theta.cols(), theta.cols());
    A.selfadjointView<Eigen::Lower>().rankUpdate(theta_.transpose());
    L_ = Eigen::LLT<MatX, Eigen::Lower>(A).matrixL();
    log_det_ = whitener_.log_det() + 2.0 * L_.diagonal().array().log().sum();
  }
  MatX white(const MatX& columns) const { return whitener_.apply(columns); }
  /// L^-1 T' columns.
  MatX absorbed(const MatX& white_columns) const {
    MatX h = theta_.transpose() * white_columns;
    L_.triangularView<Eigen::Lower>().solveInPlace(h);
    return h;
  }
  /// Twice the restricted log likelihood of every column, without constants.
  VecX log_likelihood2(const MatX& white_columns, const MatX& absorbed_part) const {
    return (absorbed_part.colwise().squaredNorm() - white_columns.colwise().squaredNorm())
               .transpose()
               .array() -
           log_det_;
  }
  VecX log_likelihood2(const MatX& columns) const {
    const MatX w = white(columns);
    return log_likelihood2(w, absorbed(w));
  }
  const Whitener& whitener() const { return whitener_; }

 private:
  Whitener whitener_;
  MatX theta_, L_;
  double log_det_ = 0.0;
};

/// Recordings, one per column: the first is the real one, the others are drawn.
MatX recordings(const LinearProblem& problem, const MatX& theta, const Whitener& driven) {
  Stream random(doubt_seed, 0, Purpose::design);
  const auto normal = [&](Eigen::Index rows) {
    MatX m(rows, draws);
    for (Eigen::Index k = 0; k < m.size(); ++k) m.data()[k] = random.normal();
    return m;
  };
  MatX all(problem.rows(), draws + 1);
  all.col(0) = problem.r0;
  all.rightCols(draws) = driven.colour(normal(problem.rows()));
  all.rightCols(draws).noalias() += theta * normal(theta.cols());
  return all;
}

/// How often a drawn value reaches the first one.
double p_of(const VecX& value) {
  const auto above = (value.tail(draws).array() >= value[0]).count();
  return (1.0 + static_cast<double>(above)) / (1.0 + draws);
}

double normal_cdf(double z) {
  return 0.5 * std::erfc(-z / std::numbers::sqrt2);
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
  constexpr double deg_per_h = detail::deg / 3600.0;
  const Usual usual[] = {
      {&NoiseModel::angle_random_walk, 3e-4 * detail::deg / 60.0, 3e-3 * detail::deg / 60.0},
      {&NoiseModel::drift_random_walk, 1e-3 * deg_per_h / 60.0, 5e-3 * deg_per_h / 60.0},
      {&NoiseModel::markov_drift, 2e-3 * deg_per_h, 1e-2 * deg_per_h},
      {&NoiseModel::acc_markov, 0.2 * problem.acc_sigma, 1.2 * problem.acc_sigma}};
  double p = normal_cdf(-2.0);
  for (const Usual& u : usual) {
    const double found = driven.*(u.sigma);
    if (found <= white.*(u.sigma)) continue;  // declared, or not there
    const double middle = 0.5 * std::log(u.low * u.high), spread = 0.5 * std::log(u.high / u.low);
    p = std::max(p, normal_cdf((std::log(found) - middle) / spread));
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
                 const NoiseModel& driven, const LoneEffect& lone, const std::vector<int>& with) {
  MatX theta(problem.rows(), problem.theta.cols() + with.size());
  theta << problem.theta, problem.extra(Eigen::all, with);
  const View noise(problem, theta, driven), plain(problem, theta, white);
  const MatX drawn = recordings(problem, theta, noise.whitener());
  const VecX as_noise = noise.log_likelihood2(drawn);

  const MatX w = plain.white(drawn), h = plain.absorbed(w);
  const MatX extra = plain.white(problem.extra), half = plain.absorbed(extra);
  const MatX g = extra.transpose() * w - half.transpose() * h;  // (K, draws + 1)
  VecX best = VecX::Zero(draws + 1);
  for (const Candidate& c : set.candidates) {
    if (c.params.size() > most_params) continue;
    for (const Variant& v : c.variants) {
      const auto n = static_cast<Eigen::Index>(v.columns.size());
      MatX part(n, g.cols()), C = MatX::Identity(n, n);
      for (Eigen::Index i = 0; i < n; ++i) {
        part.row(i) = g.row(v.columns[i]);
        for (Eigen::Index k = 0; k < n; ++k)
          C(i, k) += extra.col(v.columns[i]).dot(extra.col(v.columns[k])) -
                     half.col(v.columns[i]).dot(half.col(v.columns[k]));
      }
      const Eigen::LLT<MatX> llt(C);
      llt.matrixL().solveInPlace(part);
      best = best.cwiseMax(part.colwise().squaredNorm().transpose() -
                           VecX::Constant(g.cols(), per_degree * static_cast<double>(n - 1)));
    }
  }
  NoiseDoubt out;
  const double size = p_of_size(problem, white, driven);
  out.p_candidate = joint(p_of(best + plain.log_likelihood2(w, h) - as_noise), size);
  if (lone.gain <= 0.0) return out;
  VecX alone = VecX::Constant(draws + 1, -1e300);
  for (int axis = 0; axis < 3; ++axis) {
    NoiseModel m = white;
    m.lone = lone.input;
    m.lone.axis = axis;
    alone = alone.cwiseMax(View(problem, theta, m).log_likelihood2(drawn));
  }
  out.p_lone = joint(p_of(alone - as_noise), size);
  return out;
}

}  // namespace drift::inference
