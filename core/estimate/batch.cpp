#include "core/estimate/batch.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/base/check.hpp"
#include "core/estimate/descent/descent.hpp"
#include "core/estimate/triangle.hpp"
#include "core/physics/stochastic.hpp"
#include "core/sim/predict.hpp"

namespace drift {

Theta theta_of(const FilterSpec& filter, const BatchResult& fit) {
  Theta theta = make_layout(filter).theta;
  for (const ParameterEstimate& p : fit.estimate.parameters) theta[p.param] = p.value;
  return theta;
}

namespace {

/// What is known of where a fit begins.
enum class Known { parameters, attitudes_too };

Minimum descend_from(BatchProblem& problem, const VecX& x, const std::vector<Vec3>& psi,
                     Known known, const BatchOptions& options) {
  const auto multiplier = problem.multiplier();
  if (!multiplier) return descend(problem, x, psi, options);
  std::vector<double> beside;
  if (known == Known::parameters) beside = problem.both_equations();
  return descend_along(problem, x, psi, *multiplier, beside, options);
}

/// With angle random walk the rows are made white once more where the first descent has ended.
Minimum minimum_from(BatchProblem& problem, const VecX& x, const std::vector<Vec3>& psi,
                     Known known, const BatchOptions& options) {
  problem.whiten_at(x, psi);
  Minimum first = descend_from(problem, x, psi, known, options);
  if (!problem.walks() || !first.converged) return first;
  problem.whiten_at(first.at.x, first.at.psi);
  return descend_from(problem, first.at.x, first.at.psi, Known::attitudes_too, options);
}

/// A minimum of compressed dwells, seen sample by sample: there it is one, too, or the way goes on.
Minimum followed(BatchProblem& problem, const Minimum& from, const BatchOptions& options) {
  Minimum to = descend_from(problem, from.at.x, from.at.psi, Known::attitudes_too, options);
  to.iterations += from.iterations;
  to.converged = to.converged && from.converged;
  return to;
}

/// Whitened residuals where they belong, NaN where nothing was measured.
struct Residuals {
  Mat3X acc, gimbal;
};

std::size_t scalars_of(const MeasuredTest& test) {
  Eigen::Index count = 0;
  if (test.readout.accelerometers) count += test.measured.acc.array().isFinite().count();
  if (test.readout.gimbals) count += test.measured.gimbal.array().isFinite().count();
  return static_cast<std::size_t>(count);
}

Residuals residuals_of(const MeasuredTest& test, const std::vector<ChainEquations>& chains) {
  const auto& [timeline, readout, measured] = test;
  const Mat3X none =
      Mat3X::Constant(3, measured.acc.cols(), std::numeric_limits<double>::quiet_NaN());
  Residuals out{none, none};
  std::vector<Eigen::Index> at(timeline.chains, 0);
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i) {
    const int c = timeline.intervals[i].chain;
    const auto residual = chains[c].rows.rightCols<1>();
    const auto take = [&](const Mat3X& data_of, Mat3X& into) {
      for (int a = 0; a < 3; ++a)
        if (std::isfinite(data_of(a, i))) into(a, i) = residual[at[c]++];
    };
    if (readout.accelerometers) take(measured.acc, out.acc);
    if (readout.gimbals) take(measured.gimbal, out.gimbal);
  }
  return out;
}

/// Where a fit begins: parameters, library values, and the attitude of each chain [rad].
struct Start {
  Theta theta;
  std::vector<Vec3> psi0_l;
  Known known;
};

BatchResult fit_all(const FilterSpec& filter, const MeasuredTest& test, const Start& start,
                    const BatchOptions& options) {
  BatchProblem problem(filter, test);
  const Layout& layout = problem.layout();
  const auto n = static_cast<Eigen::Index>(layout.size());
  const VecX x_start = layout.scaled(start.theta);
  Minimum minimum =
      minimum_from(problem, x_start, problem.scaled(start.psi0_l), start.known, options);
  const bool whole = options.result == BatchOptions::Result::whole;
  if (whole && problem.compressed()) {
    problem.take_every_sample();
    minimum = followed(problem, minimum, options);
  }

  BatchResult out;
  MatX P = MatX::Zero(n, n);
  if (whole) {
    MatX prior = MatX::Zero(n, n + 1);
    prior.leftCols(n).setIdentity();
    const MatX data = compressed(minimum.at).reduced(0.0).triangle;
    const MatX R = triangle(stacked(data, prior)).topLeftCorner(n, n);
    const MatX R_inv = R.triangularView<Eigen::Upper>().solve(MatX::Identity(n, n));
    P = R_inv * R_inv.transpose();
    out.information_root = data.topLeftCorner(n, n);
    out.estimate.covariance = P;
  }
  out.estimate.parameters = parameter_estimates(layout, x_start, minimum.at.x, P);
  out.estimate.iterations = minimum.iterations;
  out.estimate.statistic = minimum.at.cost;
  out.data_chi2 = minimum.at.data_cost();
  out.psi0_l = problem.unscaled(minimum.at.psi);
  out.estimate.measured = scalars_of(test);
  if (!problem.compressed()) {
    Residuals residuals = residuals_of(test, minimum.at.rows);
    out.acc_residual = std::move(residuals.acc);
    out.gimbal_residual = std::move(residuals.gimbal);
  }
  if (!minimum.converged) {
    out.estimate.status = EstimateStatus::not_converged;
    out.estimate.cause = fmt::format("no convergence in {} iterations", minimum.iterations);
  }
  return out;
}

/// Samples of `measured` whose residual lies within the gate; the others become NaN. noise: of an
/// interval's samples, by its number.
template <class Noise>
Mat3X within(const Mat3X& measured, const Mat3X& predicted, const Noise& noise, double gate,
             bool angles) {
  Mat3X kept = measured;
  for (Eigen::Index i = 0; i < kept.cols(); ++i)
    for (int a = 0; a < 3; ++a) {
      const double r = angles ? angle_difference(measured(a, i), predicted(a, i))
                              : measured(a, i) - predicted(a, i);
      if (std::abs(r) > gate * noise(i)) kept(a, i) = std::numeric_limits<double>::quiet_NaN();
    }
  return kept;
}

bool same_samples(const Mat3X& a, const Mat3X& b) {
  return (a.array().isFinite() == b.array().isFinite()).all();
}

BatchResult fit_from(const FilterSpec& filter, const MeasuredTest& test, const Start& start,
                     const BatchOptions& options) {
  BatchResult out = fit_all(filter, test, start, options);
  const DriftModel model = filter.model();
  if (!has_outliers(model.terms)) return out;
  // Term `outliers`: what lies outside the gate is left out, and may come back, until nothing
  // changes. The gate is narrowed step by step: a fit that outliers have pulled aside has large
  // residuals.
  constexpr int most_rounds = 12;
  const auto& [timeline, readout, measured] = test;
  const auto acc_noise = [&](Eigen::Index i) {
    return test.timeline.intervals[static_cast<std::size_t>(i)].accelerometer_noise(
        test.readout.accelerometer_noise);
  };
  const auto gimbal_noise = [&](Eigen::Index i) {
    return test.timeline.intervals[static_cast<std::size_t>(i)].gimbal_noise(
        test.readout.gimbal_noise);
  };
  Measurements kept = measured;
  double gate = std::max(outlier_gate(make_layout(filter).theta), 1.0);
  double wide =
      gate * std::max(1.0, std::sqrt(out.data_chi2 / static_cast<double>(out.estimate.measured)));
  for (int round = 0; round < most_rounds; ++round) {
    const Start here{theta_of(filter, out), out.psi0_l, Known::attitudes_too};
    const Measurements predicted = predict(timeline, model, here.theta, here.psi0_l, readout);
    const Measurements now{within(measured.acc, predicted.acc, acc_noise, wide, false),
                           within(measured.gimbal, predicted.gimbal, gimbal_noise, wide, true)};
    const bool done =
        wide == gate && same_samples(now.acc, kept.acc) && same_samples(now.gimbal, kept.gimbal);
    if (done) break;
    kept = now;
    out = fit_all(filter, {timeline, readout, kept}, here, options);
    wide = std::max(gate, 0.5 * wide);
  }
  for (ParameterEstimate& p : out.estimate.parameters) p.start = start.theta[p.param];
  return out;
}

}  // namespace

BatchResult fit_batch(const FilterSpec& filter, const MeasuredTest& test, const Theta& start,
                      const BatchOptions& options) {
  DRIFT_DEMAND(is_along(test.measured, test.timeline));
  const std::vector<Vec3> level(static_cast<std::size_t>(test.timeline.chains), Vec3::Zero());
  return fit_from(filter, test, {start, level, Known::parameters}, options);
}

BatchResult fit_batch_from(const FilterSpec& filter, const MeasuredTest& test, const Theta& start,
                           const std::vector<Vec3>& psi0_l, const BatchOptions& options) {
  DRIFT_DEMAND(is_along(test.measured, test.timeline));
  DRIFT_DEMAND(psi0_l.size() == static_cast<std::size_t>(test.timeline.chains));
  return fit_from(filter, test, {start, psi0_l, Known::attitudes_too}, options);
}

}  // namespace drift
