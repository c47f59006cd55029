#include "core/estimate/closure/closure_posterior.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/estimate/descent/descent.hpp"
#include "core/estimate/triangle.hpp"

namespace drift {
namespace {

/// Everything else at one value of lambda.
struct Slice {
  double value;           ///< of lambda, in prior sigmas
  double log;             ///< of its density, up to a constant
  double attitudes;       ///< what the attitudes' determinants have of that
  double cost;            ///< of the fit there
  VecX x;                 ///< mean of all parameters there, scaled
  MatX P;                 ///< covariance of the others there
  std::vector<Vec3> psi;  ///< attitudes there, in prior sigmas
};

/// The samples that the fit used: those that it left out as outliers are missing here.
Measurements used(const MeasuredTest& test, const BatchResult& fit) {
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  Measurements out = test.measured;
  const auto mask = [&](Mat3X& measured, const Mat3X& residual) {
    if (residual.cols() == measured.cols())
      measured = residual.array().isFinite().select(measured, missing);
  };
  mask(out.acc, fit.acc_residual);
  mask(out.gimbal, fit.gimbal_residual);
  return out;
}

class ClosurePosterior {
 public:
  ClosurePosterior(const FilterSpec& filter, const MeasuredTest& test, const BatchResult& fit)
      : measured_(used(test, fit)),
        problem_(filter, {test.timeline, test.readout, measured_}),
        lambda_(*problem_.multiplier()) {
    const VecX x = problem_.layout().scaled(theta_of(filter, fit));
    const std::vector<Vec3> psi = problem_.scaled(fit.psi0_l);
    problem_.whiten_at(x, psi);
    add(x[lambda_], x, psi);
    cost_at_fit_ = slices_.front().cost;
    attitudes_at_fit_ = slices_.front().attitudes;
    look_everywhere(std::sqrt(fit.estimate.covariance(lambda_, lambda_)));
    refine();
  }

  /// EstimateResult::log_evidence. The attitudes count by how they differ from those of the fit, as
  /// of a fit at one lambda they do not count at all.
  double log_evidence(const LogGain& log_gain) const {
    const VecX mass = masses();
    double sum = 0.0;
    for (std::size_t k = 0; k < slices_.size(); ++k)
      if (mass[static_cast<Eigen::Index>(k)] > 0.0)
        sum += mass[static_cast<Eigen::Index>(k)] *
               std::exp(log_gain ? log_gain(slices_[k].x, slices_[k].P) : 0.0);
    return top_ - attitudes_at_fit_ + std::log(sum / std::sqrt(2.0 * std::numbers::pi));
  }

  struct Moments {
    VecX mean;  ///< scaled
    MatX covariance;
  };
  /// By how much the best of the slices fits better than the fit's own lambda does: it ended in a
  /// side valley, and what is told of it is told of another point.
  double better_than_fit() const {
    return std::max(0.0, cost_at_fit_ - std::ranges::min(slices_, {}, &Slice::cost).cost);
  }

  Moments moments() const {
    const Eigen::Index n = slices_.front().x.size();
    const VecX mass = masses() / masses().sum();
    Moments out{VecX::Zero(n), MatX::Zero(n, n)};
    for (std::size_t k = 0; k < slices_.size(); ++k) out.mean += mass[k] * slices_[k].x;
    for (std::size_t k = 0; k < slices_.size(); ++k) {
      const VecX off = slices_[k].x - out.mean;
      out.covariance += mass[k] * (slices_[k].P + off * off.transpose());
    }
    return out;
  }

 private:
  /// Where the density may have its mass: about the fit, at both equations, where the prior is.
  void look_everywhere(double sigma) {
    const double fitted = slices_.front().value;
    std::vector<double> values = problem_.both_equations();
    for (const double step : {1.0, 2.0, 4.0})
      for (const double sign : {-1.0, 1.0}) values.push_back(fitted + sign * step * sigma);
    for (const double prior : {0.0, 1.5, -1.5, 3.0, -3.0, 4.5, -4.5}) values.push_back(prior);
    // From the fit outward: each is begun at one beside it.
    std::ranges::sort(values, {}, [&](double v) { return std::abs(v - fitted); });
    for (const double v : values) add(v);
  }

  /// Between points until no interval holds more than a small part of the mass, nor of the variance
  /// of any parameter.
  void refine() {
    constexpr double part = 1.0 / 6.0;
    constexpr std::size_t most = 80;
    while (slices_.size() < most) {
      const std::vector<double> share = shares();
      std::size_t largest = 0;
      double bound = 0.0;
      for (std::size_t k = 0; k + 1 < slices_.size(); ++k) {
        const double here =
            (slices_[k + 1].value - slices_[k].value) * std::max(share[k], share[k + 1]);
        if (here > bound) {
          bound = here;
          largest = k;
        }
      }
      if (bound < part) return;
      add(0.5 * (slices_[largest].value + slices_[largest + 1].value));
    }
  }

  /// Of each slice, per unit of lambda: of the mass or of a parameter's variance, whichever is
  /// more.
  std::vector<double> shares() const {
    const double all = masses().sum();
    const auto [mean, covariance] = moments();
    std::vector<double> out;
    for (const Slice& s : slices_) {
      const auto about_mean = s.P.diagonal().array() + (s.x - mean).array().square();
      const double most = (about_mean / covariance.diagonal().array()).maxCoeff();
      out.push_back(density(s) / all * std::max(1.0, most));
    }
    return out;
  }

  double density(const Slice& s) const { return std::exp(s.log - top_); }

  /// Of each slice, by the trapezoidal rule.
  VecX masses() const {
    const std::size_t n = slices_.size();
    VecX out(static_cast<Eigen::Index>(n));
    for (std::size_t k = 0; k < n; ++k) {
      const double low = slices_[k > 0 ? k - 1 : k].value;
      const double high = slices_[k + 1 < n ? k + 1 : k].value;
      out[k] = 0.5 * (high - low) * density(slices_[k]);
    }
    return out;
  }

  void add(double value) {
    const auto distance = [&](const Slice& s) { return std::abs(s.value - value); };
    const Slice& near = *std::ranges::min_element(slices_, {}, distance);
    if (near.value == value) return;
    VecX x = near.x;
    x[lambda_] = value;
    add(value, std::move(x), near.psi);
  }
  void add(double value, VecX x, std::vector<Vec3> psi) {
    Minimum best = descend(problem_, std::move(x), std::move(psi), {}, lambda_);
    if (!best.converged) {  // beyond a ridge what fits beside it may be far off
      VecX prior = VecX::Zero(best.at.x.size());
      prior[lambda_] = value;
      Minimum other = descend(problem_, std::move(prior), best.at.psi, {}, lambda_);
      if (other.at.cost < best.at.cost) best = std::move(other);
    }
    Slice s = slice(value, best.at);
    top_ = std::max(top_, s.log);
    slices_.insert(std::ranges::upper_bound(slices_, value, {}, &Slice::value), std::move(s));
  }

  Slice slice(double value, const Evaluation& at) const {
    const Eigen::Index n = at.x.size();
    auto [data, tops] = compressed(at).reduced(0.0);
    data.col(lambda_).setZero();
    MatX prior = MatX::Zero(n, n + 1);
    prior.leftCols(n).setIdentity();
    const MatX R = triangle(stacked(data, prior)).topLeftCorner(n, n);
    const MatX R_inv = R.triangularView<Eigen::Upper>().solve(MatX::Identity(n, n));
    double attitudes = 0.0;
    for (const MatX& top : tops)
      attitudes -= top.leftCols<3>().diagonal().array().abs().log().sum();
    Slice s{value,     attitudes - 0.5 * at.cost - R.diagonal().array().abs().log().sum(),
            attitudes, at.cost,
            at.x,      R_inv * R_inv.transpose(),
            at.psi};
    s.P.row(lambda_).setZero();
    s.P.col(lambda_).setZero();
    return s;
  }

  Measurements measured_;
  BatchProblem problem_;
  Eigen::Index lambda_;
  std::vector<Slice> slices_;  ///< by value
  double top_ = -std::numeric_limits<double>::infinity();
  double cost_at_fit_ = 0.0, attitudes_at_fit_ = 0.0;
};

}  // namespace

EstimateResult over_closure(const FilterSpec& filter, const MeasuredTest& test,
                            const BatchResult& fit, const LogGain& log_gain) {
  EstimateResult out = fit.estimate;
  if (out.status != EstimateStatus::ok || out.find(closure_param) == nullptr) return out;
  const ClosurePosterior posterior(filter, test, fit);
  const auto [mean, P] = posterior.moments();
  out.covariance = P;
  out.statistic -= posterior.better_than_fit();
  out.log_evidence = posterior.log_evidence(log_gain);
  for (std::size_t k = 0; k < out.parameters.size(); ++k) {
    ParameterEstimate& p = out.parameters[k];
    const auto i = static_cast<Eigen::Index>(k);
    p.value = p.prior_mean + p.prior_sigma * mean[i];
    p.sigma = p.prior_sigma * std::sqrt(P(i, i));
  }
  return out;
}

bool ended_at_one_point(const BatchResult& a, const BatchResult& b) {
  const auto ok = [](const BatchResult& f) { return f.estimate.status == EstimateStatus::ok; };
  const auto same_samples = [](const Mat3X& p, const Mat3X& q) {
    return p.cols() == q.cols() && (p.array().isFinite() == q.array().isFinite()).all();
  };
  const std::vector<ParameterEstimate>&p = a.estimate.parameters, &q = b.estimate.parameters;
  if (!ok(a) || !ok(b) || p.size() != q.size() ||
      a.information_root.cols() != static_cast<Eigen::Index>(p.size()) ||
      !same_samples(a.acc_residual, b.acc_residual) ||
      !same_samples(a.gimbal_residual, b.gimbal_residual))
    return false;
  VecX apart(a.information_root.cols());
  for (std::size_t k = 0; k < p.size(); ++k)
    apart[static_cast<Eigen::Index>(k)] = (p[k].value - q[k].value) / p[k].prior_sigma;
  const double sigmas = std::hypot((a.information_root * apart).norm(), apart.norm());
  return sigmas <= 2.0 * BatchOptions{}.tolerance;
}

EstimateResult with_moments_of(const EstimateResult& over, const BatchResult& fit) {
  EstimateResult out = fit.estimate;
  out.covariance = over.covariance;
  out.log_evidence = over.log_evidence;
  out.statistic = std::min(out.statistic, over.statistic);
  for (std::size_t k = 0; k < out.parameters.size(); ++k) {
    out.parameters[k].value = over.parameters[k].value;
    out.parameters[k].sigma = over.parameters[k].sigma;
  }
  return out;
}

}  // namespace drift
