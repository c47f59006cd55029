#include "core/estimate/batch.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>

#include "core/base/decompose.hpp"
#include "core/estimate/batch_equations.hpp"
#include "core/estimate/normal_equations.hpp"
#include "core/estimate/random_walk.hpp"
#include "core/estimate/triangle.hpp"
#include "core/physics/stochastic.hpp"
#include "core/sim/predict.hpp"

namespace drift {
namespace {

/// Data cost of the last column of each chain.
double data_cost(const std::vector<ChainEquations>& chains) {
  double cost = 0.0;
  for (const auto& c : chains) cost += c.rows.rightCols<1>().squaredNorm();
  return cost;
}

}  // namespace

Theta theta_of(const FilterSpec& filter, const BatchResult& fit) {
  Theta theta = make_layout(filter).theta;
  for (const ParameterEstimate& p : fit.estimate.parameters) theta[p.param] = p.value;
  return theta;
}

namespace {

/// A test linearised at one point.
struct Evaluation {
  VecX x;                 ///< scaled parameters
  std::vector<Vec3> psi;  ///< attitude errors, scaled by their prior sigma
  std::vector<ChainEquations> rows;
  double cost = 0.0;  ///< data + prior
};

/// A filter's model and a test.
class BatchProblem {
 public:
  BatchProblem(const FilterSpec& filter, const MeasuredTest& test)
      : test_(test),
        model_(filter.model()),
        layout_(make_layout(filter)),
        sigma_psi_(filter.initial_attitude),
        angle_random_walk_(filter.noise.angle_random_walk) {}

  const MeasuredTest& test() const { return test_; }
  const Layout& layout() const { return layout_; }
  bool walks() const { return angle_random_walk_ > 0.0; }

  /// Attitude errors in radians.
  std::vector<Vec3> unscaled(const std::vector<Vec3>& psi) const {
    std::vector<Vec3> psi_l;
    for (const Vec3& p : psi) psi_l.push_back(sigma_psi_ * p);
    return psi_l;
  }

  /// With angle random walk: the cost of what evaluate() returns is that of the point at which the
  /// rows were made white last, here.
  void whiten_at(const VecX& x, const std::vector<Vec3>& psi) {
    if (!walks()) return;
    const Theta theta = layout_.theta_at(x);
    const Trajectory phi = integrate_fixed(test_.timeline, model_, theta, unscaled(psi));
    white_at_ =
        attitude_columns(measurement_equations(test_, model_, layout_, theta, phi, sigma_psi_));
  }

  Evaluation evaluate(VecX x, std::vector<Vec3> psi) const {
    const Theta theta = layout_.theta_at(x);
    const Trajectory phi = integrate_fixed(test_.timeline, model_, theta, unscaled(psi));
    Evaluation e{std::move(x), std::move(psi),
                 measurement_equations(test_, model_, layout_, theta, phi, sigma_psi_), 0.0};
    if (walks()) whiten_random_walk(test_, angle_random_walk_ / sigma_psi_, white_at_, e.rows);
    e.cost = data_cost(e.rows) + e.x.squaredNorm();
    for (const Vec3& p : e.psi) e.cost += p.squaredNorm();
    if (!std::isfinite(e.cost)) e.cost = std::numeric_limits<double>::infinity();
    return e;
  }

 private:
  MeasuredTest test_;
  DriftModel model_;
  Layout layout_;
  double sigma_psi_;
  double angle_random_walk_;
  std::vector<MatX> white_at_;
};

BatchEquations compressed(const Evaluation& e) {
  BatchEquations out{{}, e.psi, e.x};
  for (const auto& c : e.rows) out.chains.push_back(triangle(c.rows));
  return out;
}

/// Where the descent ended.
struct Minimum {
  Evaluation at;
  int iterations = 0;
  bool converged = false;
};

/// The linear problem at an evaluation: its normal equations where they are good enough for a step,
/// triangles where they are not.
class StepSolver {
 public:
  explicit StepSolver(const Evaluation& e) : normal_(e.rows, e.psi, e.x) {
    // What a step leaves undone for rounding is met again at the next evaluation, whose residuals
    // and gradient are exact: a thousandth each time.
    constexpr double of_the_prior = 1e-3;
    if (!normal_.good_to(of_the_prior)) triangles_ = compressed(e);
  }
  BatchEquations::Step solve(double mu) const {
    return triangles_ ? triangles_->solve(mu) : normal_.solve(mu);
  }

 private:
  NormalEquations normal_;
  std::optional<BatchEquations> triangles_;
};

/// Levenberg-Marquardt.
Minimum descend(const BatchProblem& problem, VecX x, std::vector<Vec3> psi,
                const BatchOptions& options) {
  const double standing_still = options.tolerance * options.tolerance;
  Minimum now{problem.evaluate(std::move(x), std::move(psi)), 0, false};
  double mu = 1e-3;
  int still = 0;  // iterations in a row that hardly lowered the cost
  for (; now.iterations < options.max_iterations && !now.converged; ++now.iterations) {
    const StepSolver solver(now.at);
    bool improved = false;
    double smallest_change = std::numeric_limits<double>::infinity();
    for (int tries = 0; tries < 20 && !improved; ++tries) {
      const BatchEquations::Step step = solver.solve(mu);
      std::vector<Vec3> moved = now.at.psi;
      for (std::size_t c = 0; c < moved.size(); ++c) moved[c] += step.dpsi[c];
      Evaluation next = problem.evaluate(now.at.x + step.dx, std::move(moved));
      // The last steps change the cost by rounding only: accept them as standing still.
      improved = next.cost <= now.at.cost * (1.0 + 1e-12);
      if (!improved) {
        smallest_change = std::min(smallest_change, next.cost - now.at.cost);
        mu *= 10.0;
        continue;
      }
      still = now.at.cost - next.cost < standing_still ? still + 1 : 0;
      // Small steps may be damping's doing; where they stay so, the cost has a kink (the onset of a
      // step that crosses a sample) and lies in it.
      now.converged = still > 0 && (mu < 1e-2 || still == 3);
      now.at = std::move(next);
      mu = std::max(mu * 0.1, 1e-12);
    }
    if (!improved) {  // at the minimum, up to rounding of the cost
      now.converged = smallest_change < standing_still;
      break;
    }
  }
  return now;
}

/// With angle random walk the rows are made white once more where the first descent has ended.
Minimum minimum_from(BatchProblem& problem, const VecX& start, const BatchOptions& options) {
  const std::vector<Vec3> nominal(static_cast<std::size_t>(problem.test().timeline.chains),
                                  Vec3::Zero());
  problem.whiten_at(start, nominal);
  Minimum first = descend(problem, start, nominal, options);
  if (!problem.walks() || !first.converged) return first;
  problem.whiten_at(first.at.x, first.at.psi);
  return descend(problem, first.at.x, first.at.psi, options);
}

/// Whitened residuals where they belong, NaN where nothing was measured.
struct Residuals {
  Mat3X acc, gimbal;
  std::size_t scalars = 0;
};

Residuals residuals_of(const MeasuredTest& test, const std::vector<ChainEquations>& chains) {
  const auto& [timeline, readout, measured] = test;
  const Mat3X none =
      Mat3X::Constant(3, measured.acc.cols(), std::numeric_limits<double>::quiet_NaN());
  Residuals out{none, none, 0};
  std::vector<Eigen::Index> at(timeline.chains, 0);
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i) {
    const int c = timeline.intervals[i].chain;
    const auto residual = chains[c].rows.rightCols<1>();
    const auto take = [&](const Mat3X& data_of, Mat3X& into) {
      for (int a = 0; a < 3; ++a)
        if (std::isfinite(data_of(a, i))) {
          into(a, i) = residual[at[c]++];
          ++out.scalars;
        }
    };
    if (readout.accelerometers) take(measured.acc, out.acc);
    if (readout.gimbals) take(measured.gimbal, out.gimbal);
  }
  return out;
}

BatchResult fit_all(const FilterSpec& filter, const MeasuredTest& test, const Theta& start,
                    const BatchOptions& options) {
  BatchProblem problem(filter, test);
  const Layout& layout = problem.layout();
  const auto n = static_cast<Eigen::Index>(layout.size());
  const VecX x_start = layout.scaled(start);
  const Minimum minimum = minimum_from(problem, x_start, options);

  MatX prior = MatX::Zero(n, n + 1);
  prior.leftCols(n).setIdentity();
  const MatX data = compressed(minimum.at).reduced(0.0).triangle;
  const MatX R = triangle(stacked(data, prior)).topLeftCorner(n, n);
  const MatX R_inv = R.triangularView<Eigen::Upper>().solve(MatX::Identity(n, n));
  const MatX P = R_inv * R_inv.transpose();
  BatchResult out;
  out.information_root = data.topLeftCorner(n, n);
  out.estimate.parameters = parameter_estimates(layout, x_start, minimum.at.x, P);
  out.estimate.covariance = P;
  out.estimate.iterations = minimum.iterations;
  out.estimate.statistic = minimum.at.cost;
  out.data_chi2 = data_cost(minimum.at.rows);
  out.psi0_l = problem.unscaled(minimum.at.psi);
  Residuals residuals = residuals_of(test, minimum.at.rows);
  out.acc_residual = std::move(residuals.acc);
  out.gimbal_residual = std::move(residuals.gimbal);
  out.estimate.measured = residuals.scalars;
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

}  // namespace

BatchResult fit_batch(const FilterSpec& filter, const MeasuredTest& test, const Theta& start,
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
  const auto gimbal_noise = [&](Eigen::Index) { return test.readout.gimbal_noise; };
  Measurements kept = measured;
  double gate = std::max(outlier_gate(make_layout(filter).theta), 1.0);
  double wide =
      gate * std::max(1.0, std::sqrt(out.data_chi2 / static_cast<double>(out.estimate.measured)));
  for (int round = 0; round < most_rounds; ++round) {
    const Theta theta = theta_of(filter, out);
    const Measurements predicted = predict(timeline, model, theta, out.psi0_l, readout);
    const Measurements now{within(measured.acc, predicted.acc, acc_noise, wide, false),
                           within(measured.gimbal, predicted.gimbal, gimbal_noise, wide, true)};
    const bool done =
        wide == gate && same_samples(now.acc, kept.acc) && same_samples(now.gimbal, kept.gimbal);
    if (done) break;
    kept = now;
    out = fit_all(filter, {timeline, readout, kept}, theta, options);
    wide = std::max(gate, 0.5 * wide);
  }
  for (ParameterEstimate& p : out.estimate.parameters) p.start = start[p.param];
  return out;
}

}  // namespace drift
