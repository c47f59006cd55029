#include "core/estimate/batch.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/base/decompose.hpp"
#include "core/estimate/triangle.hpp"
#include "core/physics/stochastic.hpp"
#include "core/sim/predict.hpp"

namespace drift {
namespace {

/// One chain reduced to triangles: [psi | x | r] with the attitude prior (and damping) on top.
struct ReducedChain {
  MatX data;  ///< triangle of the rows alone
};

/// The linear least squares problem at one point, ready to be solved for any damping.
struct Equations {
  std::vector<ReducedChain> chains;
  std::vector<Vec3> psi;  ///< present attitude errors, scaled by their prior sigma
  VecX x;                 ///< present scaled parameters
  double cost = 0.0;      ///< data + prior

  struct Step {
    VecX dx;
    std::vector<Vec3> dpsi;
  };

  /// Minimises |J d - r|^2 + |p + d|^2 + mu |d|^2.
  Step solve(double mu) const;
  /// Triangle over [x | r] with every attitude eliminated. prior: 1 keeps the parameter prior, 0
  /// not.
  MatX reduced(double mu, std::vector<MatX>* per_chain) const;
};

MatX Equations::reduced(double mu, std::vector<MatX>* per_chain) const {
  const Eigen::Index n = x.size();
  MatX sum = MatX::Zero(n + 1, n + 1);
  for (std::size_t c = 0; c < chains.size(); ++c) {
    MatX extra = MatX::Zero(mu > 0.0 ? 6 : 3, 3 + n + 1);
    extra.topLeftCorner<3, 3>().setIdentity();
    extra.block<3, 1>(0, 3 + n) = -psi[c];
    if (mu > 0.0) extra.block<3, 3>(3, 0) = std::sqrt(mu) * Mat3::Identity();
    const MatX R = triangle(stacked(chains[c].data, extra));
    if (per_chain) per_chain->push_back(R.topRows<3>());
    sum = triangle(stacked(sum, R.bottomRightCorner(n + 1, n + 1)));
  }
  return sum;
}

Equations::Step Equations::solve(double mu) const {
  const Eigen::Index n = x.size();
  std::vector<MatX> tops;
  const MatX data = reduced(mu, &tops);
  MatX extra = MatX::Zero(2 * n, n + 1);
  extra.topLeftCorner(n, n).setIdentity();
  extra.topRightCorner(n, 1) = -x;
  extra.block(n, 0, n, n) = std::sqrt(mu) * MatX::Identity(n, n);
  const MatX R = triangle(stacked(data, extra));
  Step step;
  step.dx = R.topLeftCorner(n, n).triangularView<Eigen::Upper>().solve(R.topRightCorner(n, 1));
  for (const MatX& top : tops) {
    const Vec3 right = top.rightCols<1>() - top.middleCols(3, n) * step.dx;
    step.dpsi.push_back(top.leftCols<3>().triangularView<Eigen::Upper>().solve(right));
  }
  return step;
}

/// Data cost of the last column of each chain.
double data_cost(const std::vector<ChainEquations>& chains) {
  double cost = 0.0;
  for (const auto& c : chains) cost += c.rows.rightCols<1>().squaredNorm();
  return cost;
}

}  // namespace

MatX information_root(const std::vector<ChainEquations>& chains, std::size_t parameters) {
  Equations e;
  e.x = VecX::Zero(parameters);
  for (const auto& c : chains) {
    e.chains.push_back({triangle(c.rows)});
    e.psi.push_back(Vec3::Zero());
  }
  return e.reduced(0.0, nullptr).topLeftCorner(parameters, parameters);
}

std::vector<WeakDirection> weak_directions(const MatX& information_root, double limit) {
  const Eigensystem eigen = eigensystem(information_root.transpose() * information_root);
  std::vector<WeakDirection> weak;
  for (Eigen::Index k = 0; k < eigen.values.size(); ++k)
    if (eigen.values[k] < limit)
      weak.push_back({std::max(0.0, eigen.values[k]), eigen.vectors.col(k)});
  return weak;
}

Theta theta_of(const FilterSpec& filter, const BatchResult& fit) {
  Theta theta = make_layout(filter).theta;
  for (const ParameterEstimate& p : fit.estimate.parameters) theta[p.param] = p.value;
  return theta;
}

namespace {

BatchResult fit_all(const FilterSpec& filter, const Timeline& timeline, const Readout& readout,
                    const Measurements& measured, const Theta& start, const BatchOptions& options) {
  const DriftModel model = filter.model();
  const Layout layout = make_layout(filter);
  const auto n = static_cast<Eigen::Index>(layout.size());
  const double sigma_psi = filter.initial_attitude;
  BatchResult out;

  std::vector<ChainEquations> rows;
  const auto evaluate = [&](const VecX& x, const std::vector<Vec3>& psi) {
    Equations e;
    e.x = x;
    e.psi = psi;
    std::vector<Vec3> psi_l;
    for (const Vec3& p : psi) psi_l.push_back(sigma_psi * p);
    const Theta theta = layout.theta_at(x);
    const Trajectory phi = integrate_fixed(timeline, model, theta, psi_l);
    rows = measurement_equations(timeline, model, layout, readout, measured, theta, phi, sigma_psi);
    e.cost = data_cost(rows) + x.squaredNorm();
    for (const Vec3& p : psi) e.cost += p.squaredNorm();
    if (!std::isfinite(e.cost)) e.cost = std::numeric_limits<double>::infinity();
    return e;
  };
  const auto compress = [&](Equations& e) {
    for (const auto& c : rows) e.chains.push_back({triangle(c.rows)});
  };

  const VecX x_start = layout.scaled(start);
  Equations now = evaluate(x_start, std::vector<Vec3>(timeline.chains, Vec3::Zero()));
  compress(now);
  std::vector<ChainEquations> rows_now = std::move(rows);
  double mu = 1e-3;
  bool converged = false;
  int iteration = 0;
  for (; iteration < options.max_iterations && !converged; ++iteration) {
    bool improved = false;
    double smallest_change = std::numeric_limits<double>::infinity();
    for (int tries = 0; tries < 20 && !improved; ++tries) {
      const Equations::Step step = now.solve(mu);
      std::vector<Vec3> psi = now.psi;
      for (std::size_t c = 0; c < psi.size(); ++c) psi[c] += step.dpsi[c];
      Equations next = evaluate(now.x + step.dx, psi);
      // The last steps change the cost by rounding only: accept them as standing still.
      if (next.cost <= now.cost * (1.0 + 1e-12)) {
        converged = now.cost - next.cost < options.tolerance * options.tolerance && mu < 1e-2;
        compress(next);
        now = std::move(next);
        rows_now = std::move(rows);
        mu = std::max(mu * 0.1, 1e-12);
        improved = true;
      } else {
        smallest_change = std::min(smallest_change, next.cost - now.cost);
        mu *= 10.0;
      }
    }
    if (!improved) {  // at the minimum, up to rounding of the cost
      converged = smallest_change < options.tolerance * options.tolerance;
      break;
    }
  }

  MatX prior = MatX::Zero(n, n + 1);
  prior.leftCols(n).setIdentity();
  const MatX data = now.reduced(0.0, nullptr);
  const MatX R = triangle(stacked(data, prior)).topLeftCorner(n, n);
  const MatX R_inv = R.triangularView<Eigen::Upper>().solve(MatX::Identity(n, n));
  const MatX P = R_inv * R_inv.transpose();
  out.information_root = data.topLeftCorner(n, n);
  out.estimate.parameters = parameter_estimates(layout, x_start, now.x, P);
  out.estimate.covariance = P;
  out.estimate.iterations = iteration;
  out.estimate.statistic = now.cost;
  out.data_chi2 = data_cost(rows_now);
  for (const Vec3& p : now.psi) out.psi0_l.push_back(sigma_psi * p);
  out.acc_residual =
      Mat3X::Constant(3, measured.acc.cols(), std::numeric_limits<double>::quiet_NaN());
  out.gimbal_residual = out.acc_residual;
  std::vector<Eigen::Index> at(timeline.chains, 0);
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i) {
    const int c = timeline.intervals[i].chain;
    const auto take = [&](const Mat3X& data_of, Mat3X& into) {
      for (int a = 0; a < 3; ++a)
        if (std::isfinite(data_of(a, i))) {
          into(a, i) = rows_now[c].rows(at[c]++, 3 + n);
          ++out.estimate.measured;
        }
    };
    if (readout.accelerometers) take(measured.acc, out.acc_residual);
    if (readout.gimbals) take(measured.gimbal, out.gimbal_residual);
  }
  if (!converged) {
    out.estimate.status = EstimateStatus::not_converged;
    out.estimate.cause = fmt::format("no convergence in {} iterations", iteration);
  }
  return out;
}

/// Samples of `measured` whose residual lies within the gate; the others become NaN.
Mat3X within(const Mat3X& measured, const Mat3X& predicted, double noise, double gate,
             bool angles) {
  Mat3X kept = measured;
  for (Eigen::Index i = 0; i < kept.cols(); ++i)
    for (int a = 0; a < 3; ++a) {
      const double r = angles ? angle_difference(measured(a, i), predicted(a, i))
                              : measured(a, i) - predicted(a, i);
      if (std::abs(r) > gate * noise) kept(a, i) = std::numeric_limits<double>::quiet_NaN();
    }
  return kept;
}

bool same_samples(const Mat3X& a, const Mat3X& b) {
  return (a.array().isFinite() == b.array().isFinite()).all();
}

}  // namespace

BatchResult fit_batch(const FilterSpec& filter, const Timeline& timeline, const Readout& readout,
                      const Measurements& measured, const Theta& start,
                      const BatchOptions& options) {
  BatchResult out = fit_all(filter, timeline, readout, measured, start, options);
  const DriftModel model = filter.model();
  if (!has_outliers(model.terms)) return out;
  // Term `outliers`: what lies outside the gate is left out, and may come back, until nothing
  // changes. The gate is narrowed step by step: a fit that outliers have pulled aside has large
  // residuals.
  constexpr int most_rounds = 12;
  Measurements kept = measured;
  double gate = std::max(outlier_gate(make_layout(filter).theta), 1.0);
  double wide =
      gate * std::max(1.0, std::sqrt(out.data_chi2 / static_cast<double>(out.estimate.measured)));
  for (int round = 0; round < most_rounds; ++round) {
    const Theta theta = theta_of(filter, out);
    const Measurements predicted = predict(timeline, model, theta, out.psi0_l, readout);
    const Measurements now{
        within(measured.acc, predicted.acc, readout.accelerometer_noise, wide, false),
        within(measured.gimbal, predicted.gimbal, readout.gimbal_noise, wide, true)};
    const bool done =
        wide == gate && same_samples(now.acc, kept.acc) && same_samples(now.gimbal, kept.gimbal);
    if (done) break;
    kept = now;
    out = fit_all(filter, timeline, readout, kept, theta, options);
    wide = std::max(gate, 0.5 * wide);
  }
  for (ParameterEstimate& p : out.estimate.parameters) p.start = start[p.param];
  return out;
}

}  // namespace drift
