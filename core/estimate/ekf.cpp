#include "core/estimate/ekf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/physics/stochastic.hpp"

namespace drift {
namespace {

const auto fixed_drift_key = TermLibrary::index("D_F_x");

std::size_t most_nodes(const Timeline& timeline) {
  std::size_t most = 0;
  for (const Interval& i : timeline.intervals) most = std::max(most, i.node_count());
  return most;
}

}  // namespace

Ekf::Ekf(const FilterSpec& filter, const Timeline& timeline, const Readout& readout,
         const Theta& start, KeepHistory keep)
    : filter_(filter),
      timeline_(timeline),
      readout_(readout),
      model_(filter.model()),
      layout_(make_layout(filter)),
      linearizer_(model_, layout_, readout),
      memory_(timeline, model_),
      P_(layout_.size(), layout_.num_rate, filter.initial_attitude),
      x_(layout_.scaled(start)),
      start_(x_),
      rest_G_(Mat3X::Zero(3, layout_.num_rate)),
      nodes_(most_nodes(timeline)),
      keep_(keep) {
  const std::size_t n = keep == KeepHistory::yes ? timeline.intervals.size() : 0;
  require_covariates(model_, timeline);
  history_.estimate.resize(layout_.size(), n);
  history_.sigma.resize(layout_.size(), n);
  history_.nis.resize(n);
  history_.scalars.resize(n);
  history_.t.resize(n);
  reset(start);
}

void Ekf::reset(const Theta& start) {
  for (std::size_t k = 0; k < layout_.size(); ++k)
    x_[k] = (start[layout_.params[k]] - layout_.mean[k]) / layout_.sigma[k];
  start_ = x_;
  theta_ = layout_.theta_at(x_);
  P_.reset(filter_.initial_attitude);
  phi_.setZero();
  memory_.reset();
  history_.estimate.setZero();
  history_.sigma.setZero();
  std::fill(history_.nis.begin(), history_.nis.end(), 0.0);
  std::fill(history_.scalars.begin(), history_.scalars.end(), 0);
  std::fill(history_.t.begin(), history_.t.end(), 0.0);
  sums_ = {};
  status_ = EstimateStatus::ok;
  cause_.clear();
  t_diverged_ = 0.0;
}

void Ekf::correct_attitude(const Node& node, const Vec3& psi_i, Vec3& phi) const {
  const Vec3 psi_r = node.R_lr.transpose() * (node.R_il.transpose() * psi_i);
  phi = rotation_vector(rotation(psi_r) * rotation(phi));
}

void Ekf::take(const Covariance::Update& update, std::size_t i, InnovationSums::Channel channel) {
  if (keep_ == KeepHistory::yes) {
    history_.nis[i] += update.nis;
    history_.scalars[i] += update.scalars;
  }
  sums_.add(update, channel);
  const bool finite = std::isfinite(update.nis) && x_.allFinite();
  if (status_ == EstimateStatus::ok && (!update.ok || !finite || x_.cwiseAbs().maxCoeff() > 1e6)) {
    status_ = EstimateStatus::diverged;
    t_diverged_ = timeline_.intervals[i].t1;
    cause_ = fmt::format("filter diverged at t = {:.6g} s ({})", t_diverged_,
                         !update.ok ? "innovation covariance not positive definite"
                                    : "estimate beyond 1e6 prior sigma");
  }
}

/// The corrected estimate, and what the past has left according to it.
void Ekf::learn() {
  if (!memory_.active()) {
    theta_ = layout_.theta_at(x_);
    return;
  }
  const Theta before = theta_;
  theta_ = layout_.theta_at(x_);
  memory_.shift(before.data(), theta_.data());
}

/// Innovations without those that lie outside the gate of the term `outliers`: NaN is left out.
Vec3 Ekf::gated(const Vec3& nu, const Mat3& H_psi, const Mat3X& H_par, double sigma) const {
  if (!has_outliers(model_.terms)) return nu;
  const auto n = static_cast<Eigen::Index>(layout_.size());
  Mat3X H = Mat3X::Zero(3, n);
  if (H_par.cols() > 0) H.rightCols(H_par.cols()) = H_par;
  const Mat3 cross = H * P_.cross().topRows(n) * H_psi.transpose();
  const Mat3 S = H_psi * P_.attitude() * H_psi.transpose() + cross + cross.transpose() +
                 H * P_.parameters() * H.transpose() + sigma * sigma * Mat3::Identity();
  const double gate = outlier_gate(theta_);
  Vec3 inside = nu;
  for (int k = 0; k < 3; ++k)
    if (std::abs(nu[k]) > gate * std::sqrt(S(k, k)))
      inside[k] = std::numeric_limits<double>::quiet_NaN();
  return inside;
}

void Ekf::process(std::size_t i, const Vec3& acc, const Vec3& gimbal) {
  const Interval& interval = timeline_.intervals[i];
  if (interval.cage) {
    phi_.setZero();
    P_.recage(filter_.initial_attitude);
  }
  if (keep_ == KeepHistory::yes) history_.t[i] = interval.t1;
  if (status_ != EstimateStatus::ok) return;

  const Mat3 E_loop = misalignment_matrix(model_.mounting, interval.loop);
  linearizer_.set_theta(theta_);
  memory_.advance(i, theta_.data());
  nodes_[0] = phi_;
  Drive drive = drive_of(interval, timeline_, model_, theta_);
  step_through(interval, timeline_, drive, nodes_.data(), 0, &memory_);
  linearize_interval(interval, timeline_, E_loop, nodes_.data(), linearizer_, sensitivity_,
                     &memory_);

  const std::size_t last = interval.node_count() - 1;
  const std::size_t middle = static_cast<std::size_t>(interval.substeps);
  const double arw = filter_.noise.angle_random_walk;
  const Mat3 Q_half = 0.5 * arw * arw * interval.length() * Mat3::Identity();
  const Mat3& Phi_m = sensitivity_.Phi[middle];
  P_.propagate(Phi_m, sensitivity_.G[middle], Q_half);

  if (readout_.accelerometers && acc.array().isFinite().any()) {
    const MeanOutput mean = mean_output(interval, sensitivity_);
    const Covariance::Update update = P_.update(
        gated(acc - mean.acc, mean.H, sensitivity_.jacobian[0].H_par, readout_.accelerometer_noise),
        mean.H, sensitivity_.jacobian[0].H_par, layout_.num_rate, readout_.accelerometer_noise, x_);
    take(update, i, InnovationSums::accelerometers);
    if (status_ != EstimateStatus::ok) return;
    correct_attitude(timeline_.nodes[interval.first_node + middle], update.attitude,
                     nodes_[middle]);
    learn();
    drive = drive_of(interval, timeline_, model_, theta_);
    step_through(interval, timeline_, drive, nodes_.data(), middle, &memory_);
  }

  const Mat3 Phi_rest = sensitivity_.Phi[last] * Phi_m.inverse();
  rest_G_ = sensitivity_.G[last];
  rest_G_.noalias() -= Phi_rest * sensitivity_.G[middle];
  P_.propagate(Phi_rest, rest_G_, Q_half);
  phi_ = nodes_[last];

  if (readout_.gimbals && gimbal.array().isFinite().any()) {
    const Node& node = timeline_.nodes[interval.last_node()];
    if (TermLibrary::act_on_gimbals(model_.terms)) linearizer_.set_theta(theta_);
    const GimbalPrediction predicted = linearizer_.gimbals(
        timeline_, interval, phi_, memory_.active() ? &memory_.at(2 * last) : nullptr);
    Vec3 nu;
    for (int k = 0; k < 3; ++k) nu[k] = angle_difference(gimbal[k], predicted.angles[k]);
    const Covariance::Update update =
        P_.update(gated(nu, predicted.H, predicted.H_par, readout_.gimbal_noise), predicted.H,
                  predicted.H_par, predicted.H_par.cols() > 0 ? layout_.num_rate : 0,
                  readout_.gimbal_noise, x_);
    take(update, i, InnovationSums::gimbals);
    if (status_ != EstimateStatus::ok) return;
    correct_attitude(node, update.attitude, phi_);
    learn();
  }
  if (drift_varies(filter_.noise, model_.terms)) {
    for (std::size_t k = 0; k < layout_.size(); ++k) {
      if (layout_.params[k] < fixed_drift_key || layout_.params[k] >= fixed_drift_key + 3) continue;
      const auto axis = static_cast<int>(layout_.params[k] - fixed_drift_key);
      const double variance =
          drift_variance(filter_.noise, model_.terms, theta_, axis, interval.length());
      P_.add_variance(k, variance / (layout_.sigma[k] * layout_.sigma[k]));
    }
  }
  if (keep_ == KeepHistory::no) return;
  for (std::size_t k = 0; k < layout_.size(); ++k) {
    history_.estimate(k, i) = theta_[layout_.params[k]];
    history_.sigma(k, i) = sigma(k);
  }
}

EstimateResult Ekf::result() const {
  EstimateResult r;
  r.status = status_;
  r.cause = cause_;
  r.parameters = parameter_estimates(layout_, start_, x_, P_.parameters());
  r.covariance = P_.parameters();
  r.statistic = sums_.nis;
  r.measured = sums_.scalars;
  return r;
}

EstimateResult run_ekf(const FilterSpec& filter, const Timeline& timeline, const Readout& readout,
                       const Measurements& measured, const Theta& start, EkfHistory* history) {
  Ekf ekf(filter, timeline, readout, start, history ? KeepHistory::yes : KeepHistory::no);
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i)
    ekf.process(i, measured.acc.col(i), measured.gimbal.col(i));
  if (history) *history = ekf.history();
  return ekf.result();
}

}  // namespace drift
