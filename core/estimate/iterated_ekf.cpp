#include "core/estimate/iterated_ekf.hpp"

#include <fmt/format.h>

#include <Eigen/LU>

namespace drift {
namespace {

const auto fixed_drift_key = TermLibrary::index("D_F_x");

}  // namespace

IteratedEkf::IteratedEkf(const FilterSpec& filter, const Timeline& timeline, const Readout& readout,
                         const Theta& start)
    : filter_(filter),
      timeline_(timeline),
      readout_(readout),
      model_(filter.model()),
      layout_(make_layout(filter)),
      ekf_(filter, timeline, readout, start, KeepHistory::no),
      linearizer_(model_, layout_, readout),
      P_(layout_.size(), layout_.num_rate, filter.initial_attitude),
      x_(layout_.scaled(start)),
      x_start_(x_),
      x_reference_(x_),
      dx_(x_),
      theta_(start),
      phi_(timeline.nodes.size(), Vec3::Zero()),
      phi_end_(static_cast<std::size_t>(timeline.chains), Vec3::Zero()),
      rest_G_(Mat3X::Zero(3, static_cast<Eigen::Index>(layout_.num_rate))) {}

void IteratedEkf::diverge(std::string cause, double t) {
  if (status_ != EstimateStatus::ok) return;
  status_ = EstimateStatus::diverged;
  cause_ = std::move(cause);
  t_diverged_ = t;
}

void IteratedEkf::run(const Measurements& measured, const Theta& start) {
  status_ = EstimateStatus::ok;
  cause_.clear();
  sums_ = {};
  first_pass(measured, start);
  if (status_ != EstimateStatus::ok) return;
  for (std::size_t k = 0; k < layout_.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    x_start_[i] =
        (start[static_cast<Eigen::Index>(layout_.params[k])] - layout_.mean[i]) / layout_.sigma[i];
  }
  x_ = ekf_.x();
  constexpr int most_passes = 4;
  for (int pass = 0; pass < most_passes && status_ == EstimateStatus::ok; ++pass) {
    linear_pass(measured);
    if (largest_step() < 1.0) break;  // what is left is of second order in less than a sigma
  }
}

void IteratedEkf::linear_pass(const Measurements& measured) {
  sums_ = {};
  x_reference_ = x_;
  theta_ = layout_.theta_at(x_);
  place_reference();
  P_.reset(filter_.initial_attitude);
  dx_ = x_start_ - x_reference_;
  linearizer_.set_theta(theta_);
  for (std::size_t i = 0; i < timeline_.intervals.size() && status_ == EstimateStatus::ok; ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    process(i, measured.acc.col(column), measured.gimbal.col(column));
  }
  x_ = x_reference_ + dx_;
  theta_ = layout_.theta_at(x_);
  if (!x_.allFinite() || x_.cwiseAbs().maxCoeff() > 1e6)
    diverge("second pass of the filter diverged (estimate beyond 1e6 prior sigma)",
            timeline_.intervals.back().t1);
}

double IteratedEkf::largest_step() const {
  double largest = 0.0;
  for (std::size_t k = 0; k < layout_.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    largest = std::max(largest, std::abs(x_[i] - x_reference_[i]) / std::sqrt(P_.variance(k)));
  }
  return largest;
}

void IteratedEkf::first_pass(const Measurements& measured, const Theta& start) {
  ekf_.reset(start);
  for (std::size_t i = 0; i < timeline_.intervals.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    ekf_.process(i, measured.acc.col(column), measured.gimbal.col(column));
    if (ekf_.status() != EstimateStatus::ok) {
      diverge(ekf_.cause(), ekf_.t_diverged());
      return;
    }
    phi_end_[static_cast<std::size_t>(timeline_.intervals[i].chain)] = ekf_.phi();
  }
}

void IteratedEkf::place_reference() {
  const auto& intervals = timeline_.intervals;
  Vec3 phi = Vec3::Zero();
  for (std::size_t i = intervals.size(); i-- > 0;) {
    const Interval& interval = intervals[i];
    if (i + 1 == intervals.size() || intervals[i + 1].cage)
      phi = phi_end_[static_cast<std::size_t>(interval.chain)];
    const Drive drive = drive_of(interval, timeline_, model_, theta_);
    const double step = interval.length() / (2.0 * interval.substeps);
    phi_[interval.last_node()] = phi;
    for (std::size_t n = interval.last_node(); n-- > interval.first_node;)
      phi = phi_[n] = step_attitude_back(drive, &timeline_.nodes[n], step, phi);
  }
}

void IteratedEkf::process(std::size_t i, const Vec3& acc, const Vec3& gimbal) {
  const Interval& interval = timeline_.intervals[i];
  const auto rates = static_cast<Eigen::Index>(layout_.num_rate);
  const auto others = static_cast<Eigen::Index>(layout_.size()) - rates;
  if (interval.cage) {  // the attitude is believed to be nominal: the reference taken back
    const Node& node = timeline_.nodes[interval.first_node];
    psi_ = node.R_il * (node.R_lr * -phi_[interval.first_node]);
    P_.recage(filter_.initial_attitude);
  }
  linearize_interval(interval, timeline_, misalignment_matrix(model_.mounting, interval.loop),
                     &phi_[interval.first_node], linearizer_, sensitivity_);
  const std::size_t last = interval.node_count() - 1;
  const auto middle = static_cast<std::size_t>(interval.substeps);
  const double arw = filter_.noise.angle_random_walk;
  const Mat3 Q_half = 0.5 * arw * arw * interval.length() * Mat3::Identity();
  const auto take = [&](const Covariance::Update& update, InnovationSums::Channel channel) {
    psi_ += update.attitude;
    sums_.add(update, channel);
    if (!update.ok || !std::isfinite(update.nis))
      diverge(fmt::format(
                  "second pass of the filter diverged at t = {:.6g} s (innovation covariance not "
                  "positive definite)",
                  interval.t1),
              interval.t1);
  };

  const Mat3& Phi_m = sensitivity_.Phi[middle];
  psi_ = (Phi_m * psi_ + sensitivity_.G[middle] * dx_.head(rates)).eval();
  P_.propagate(Phi_m, sensitivity_.G[middle], Q_half);
  if (readout_.accelerometers && acc.array().isFinite().any()) {
    const MeanOutput mean = mean_output(interval, sensitivity_);
    const Mat3X& H_par = sensitivity_.jacobian[0].H_par;
    const Vec3 nu = acc - mean.acc - mean.H * psi_ - H_par * dx_.tail(others);
    take(P_.update(nu, mean.H, H_par, layout_.num_rate, readout_.accelerometer_noise, dx_),
         InnovationSums::accelerometers);
  }
  const Mat3 Phi_rest = sensitivity_.Phi[last] * Phi_m.inverse();
  rest_G_ = sensitivity_.G[last];
  rest_G_.noalias() -= Phi_rest * sensitivity_.G[middle];
  psi_ = (Phi_rest * psi_ + rest_G_ * dx_.head(rates)).eval();
  P_.propagate(Phi_rest, rest_G_, Q_half);
  if (readout_.gimbals && gimbal.array().isFinite().any()) {
    const GimbalPrediction predicted = predict_gimbals(
        timeline_.nodes[interval.last_node()], interval.heading1, phi_[interval.last_node()]);
    Vec3 nu;
    for (int k = 0; k < 3; ++k) nu[k] = angle_difference(gimbal[k], predicted.angles[k]);
    nu -= predicted.H * psi_;
    take(P_.update(nu, predicted.H, Mat3X(3, 0), 0, readout_.gimbal_noise, dx_),
         InnovationSums::gimbals);
  }
  const Node& end = timeline_.nodes[interval.last_node()];
  const Vec3 psi_r = end.R_lr.transpose() * (end.R_il.transpose() * psi_);
  phi_end_[static_cast<std::size_t>(interval.chain)] =
      rotation_vector(rotation(psi_r) * rotation(phi_[interval.last_node()]));
  if (filter_.noise.drift_random_walk > 0.0) {
    const double q = filter_.noise.drift_random_walk;
    for (std::size_t k = 0; k < layout_.size(); ++k)
      if (layout_.params[k] >= fixed_drift_key && layout_.params[k] < fixed_drift_key + 3)
        P_.add_variance(k, q * q * interval.length() /
                               std::pow(layout_.sigma[static_cast<Eigen::Index>(k)], 2));
  }
}

}  // namespace drift
