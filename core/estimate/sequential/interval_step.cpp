#include "core/estimate/sequential/interval_step.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "core/base/check.hpp"
#include "core/estimate/rest_rate.hpp"
#include "core/estimate/sequential/drift_walk.hpp"
#include "core/physics/stochastic.hpp"
#include "core/plan/stretches_and_chains.hpp"
#include "core/sim/measurements.hpp"

namespace drift {
IntervalStep::IntervalStep(const FilterSpec& filter, const Timeline& timeline,
                           const Readout& readout)
    : filter_(filter),
      timeline_(timeline),
      readout_(readout),
      model_(filter.model()),
      layout_(make_layout(filter)),
      walking_(walking_states(filter, layout_)),
      linearizer_(model_, layout_, readout),
      memory_(timeline, model_),
      beginnings_(of_several_recordings(timeline) ? walking_.size() : 0),
      P_(layout_.size() + beginnings_, layout_.num_rate, filter.initial_attitude),
      x_(VecX::Zero(layout_.size() + beginnings_)),
      nodes_(most_nodes(timeline)),
      rest_G_(padded_rows(layout_.num_rate)) {
  require_covariates(model_, timeline);
}

void IntervalStep::reset(const VecX& x, const Theta& theta) {
  x_.head(x.size()) = x;
  theta_ = theta;
  linearizer_.set_theta(theta_);
  P_.reset(filter_.initial_attitude);
  for (std::size_t k = 0; k < beginnings_; ++k) {
    P_.set_equal(layout_.size() + k, walking_[k]);
    x_[layout_.size() + k] = x_[walking_[k]];
  }
  phi_.setZero();
  sums_ = {};
  status_ = EstimateStatus::ok;
  cause_.clear();
  t_diverged_ = 0.0;
}

IntervalStep::Taken IntervalStep::process(std::size_t i, const Vec3& acc, const Vec3& gimbal) {
  taken_ = {};
  if (status_ != EstimateStatus::ok) return taken_;
  const Interval& interval = timeline_.intervals[i];
  if (follows_a_recording(timeline_, i)) let_drift_begin_anew();
  linearise(i);
  let_drift_vary(time_since_before(timeline_, i));

  const std::size_t last = interval.node_count() - 1;
  const auto middle = static_cast<std::size_t>(interval.substeps);
  const double arw = filter_.noise.angle_random_walk;
  const bool holds = arw > 0.0 && !interval.rest;
  held_ = holds ? held_noise(interval, timeline_) : HeldNoise{};
  noise_.setZero();
  const double variance = arw * arw / interval.length();  // [rad^2/s^2]
  if (holds) P_.hold(variance);
  const Mat3& Phi_m = sensitivity_.Phi[middle];
  predict(Phi_m, sensitivity_.G[middle], held_.to_middle);
  if (readout_.accelerometers && acc.array().isFinite().any()) take_accelerometers(interval, acc);
  if (status_ != EstimateStatus::ok) return taken_;

  const Mat3 Phi_rest = sensitivity_.Phi[last] * Phi_m.inverse();
  rest_G_ = sensitivity_.G[last];
  rest_G_.noalias() -= Phi_rest * sensitivity_.G[middle];
  predict(Phi_rest, rest_G_, held_.from_middle);
  if (holds) {
    P_.disturb(variance * held_.anew * held_.anew.transpose());
    nodes_[last] =
        turned(timeline_.nodes[interval.last_node()], held_.from_middle * noise_, nodes_[last]);
  }
  if (readout_.gimbals && gimbal.array().isFinite().any()) take_gimbals(interval, gimbal);
  if (status_ != EstimateStatus::ok) return taken_;

  phi_ = nodes_[last];
  return taken_;
}

void IntervalStep::linearise(std::size_t i) {
  const Interval& interval = timeline_.intervals[i];
  memory_.advance(i, theta_.data());
  if (interval.cage) P_.recage(filter_.initial_attitude);
  nodes_[0] = interval.cage ? Vec3::Zero() : phi_;
  step_through(interval, timeline_, drive_of(interval, timeline_, model_, theta_), memory_.steps(),
               nodes_.data());
  linearizer_.set_theta(theta_);
  linearize_interval(interval, timeline_, misalignment_matrix(model_.mounting, interval.loop),
                     nodes_.data(), memory_.points(), linearizer_, sensitivity_);
}

void IntervalStep::predict(const Mat3& Phi, const Rows3& G, const Mat3& N) {
  P_.propagate(Phi, G.leftCols(static_cast<Eigen::Index>(layout_.num_rate)));
  if (filter_.noise.angle_random_walk > 0.0) P_.drive(N);
}

/// Without the columns that fill up lanes.
IntervalStep::Sensitivity IntervalStep::sensitivity_of(const Mat3& psi, const Rows3& rate,
                                                       const Rows3& par) const {
  const auto nr = static_cast<Eigen::Index>(layout_.num_rate);
  const auto np = static_cast<Eigen::Index>(layout_.size()) - nr;
  return {psi, rate.leftCols(std::min(rate.cols(), nr)), par.leftCols(std::min(par.cols(), np)),
          nullptr};
}

void IntervalStep::take_accelerometers(const Interval& interval, const Vec3& acc) {
  mean_output(interval, sensitivity_, mean_);
  const auto middle = static_cast<std::size_t>(interval.substeps);
  Sensitivity H = sensitivity_of(mean_.H, mean_.H_rate, mean_.H_par);
  H.held = &held_.beside;
  update(interval, middle, acc - mean_.acc, H,
         interval.accelerometer_noise(readout_.accelerometer_noise),
         InnovationSums::accelerometers);
  if (status_ == EstimateStatus::ok)
    step_through(interval, timeline_, drive_of(interval, timeline_, model_, theta_),
                 memory_.steps(), nodes_.data(), middle);
}

void IntervalStep::take_gimbals(const Interval& interval, const Vec3& gimbal) {
  const std::size_t last = interval.node_count() - 1;
  if (TermLibrary::act_on_gimbals(model_.terms)) linearizer_.set_theta(theta_);
  const GimbalPrediction predicted =
      interval.rest ? predict_rest_rate(interval, timeline_, nodes_.data(), sensitivity_)
                    : linearizer_.gimbals(timeline_, {&timeline_.nodes[interval.last_node()],
                                                      &interval, nodes_[last], memory_at(last)});
  Vec3 residual;
  for (int k = 0; k < 3; ++k) residual[k] = angle_difference(gimbal[k], predicted.angles[k]);
  update(interval, last, residual, sensitivity_of(predicted.H, predicted.H_rate, predicted.H_par),
         interval.gimbal_noise(readout_.gimbal_noise), InnovationSums::gimbals);
}

/// Takes in three scalars at a node. residual: measured minus predicted along the path.
void IntervalStep::update(const Interval& interval, std::size_t node, const Vec3& residual,
                          const Sensitivity& H, double noise, InnovationSums::Channel channel) {
  const Vec3 nu = has_outliers(model_.terms) ? gated(residual, H, noise) : residual;
  const Covariance::Update update = P_.update(nu, H.psi, H.rate, H.par, noise, x_, H.held);
  noise_ += update.held;
  taken_.nis += update.nis;
  taken_.scalars += update.scalars;
  sums_.add(update, channel);
  notice_divergence(update, interval.t1);
  if (status_ != EstimateStatus::ok) return;
  nodes_[node] = turned(timeline_.nodes[interval.first_node + node], update.attitude, nodes_[node]);
  learn();
}

/// Innovations without those that lie outside the gate of the term `outliers`: NaN is left out.
Vec3 IntervalStep::gated(const Vec3& nu, const Sensitivity& H, double noise) const {
  const auto n = static_cast<Eigen::Index>(layout_.size());
  Rows3 H_x = Rows3::Zero(3, n);
  if (H.rate.cols() > 0) H_x.leftCols(H.rate.cols()) = H.rate;
  if (H.par.cols() > 0) H_x.rightCols(H.par.cols()) = H.par;
  const Mat3 cross = H_x * P_.cross().topRows(n) * H.psi.transpose();
  const Mat3 S = H.psi * P_.attitude() * H.psi.transpose() + cross + cross.transpose() +
                 H_x * P_.parameters().topLeftCorner(n, n) * H_x.transpose() +
                 noise * noise * Mat3::Identity();
  const double gate = outlier_gate(theta_);
  Vec3 inside = nu;
  for (int k = 0; k < 3; ++k)
    if (std::abs(nu[k]) > gate * std::sqrt(S(k, k)))
      inside[k] = std::numeric_limits<double>::quiet_NaN();
  return inside;
}

void IntervalStep::notice_divergence(const Covariance::Update& update, double t) {
  const bool finite = std::isfinite(update.nis) && x_.allFinite();
  if (update.ok && finite && x_.cwiseAbs().maxCoeff() <= 1e6) return;
  status_ = EstimateStatus::diverged;
  t_diverged_ = t;
  cause_ = fmt::format("filter diverged at t = {:.6g} s ({})", t,
                       !update.ok ? "innovation covariance not positive definite"
                                  : "estimate beyond 1e6 prior sigma");
}

/// The corrected estimate, and what the past has left according to it.
void IntervalStep::learn() {
  if (!memory_.active()) {
    theta_ = layout_.theta_at(x_);
    return;
  }
  const Theta before = theta_;
  theta_ = layout_.theta_at(x_);
  memory_.shift(before.data(), theta_.data());
}

void IntervalStep::let_drift_vary(double duration) {
  for (const std::size_t k : walking_)
    P_.add_variance(k, walk_variance(filter_, layout_, k, theta_, duration));
}

/// In every recording a drift that varies begins where it did in the first.
void IntervalStep::let_drift_begin_anew() {
  for (std::size_t k = 0; k < beginnings_; ++k) {
    const std::size_t state = walking_[k], beginning = layout_.size() + k;
    P_.set_equal(state, beginning);
    P_.add_variance(state, variance_between_recordings(filter_, layout_, state, theta_));
    x_[state] = x_[beginning];
  }
  if (beginnings_ > 0) learn();
}

const MemoryPoint* IntervalStep::memory_at(std::size_t node) const {
  const MemoryPoint* points = memory_.points();
  return points ? points + 2 * node : nullptr;
}

}  // namespace drift
