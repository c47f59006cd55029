#include "core/estimate/sequential/interval_rows.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/estimate/rest_rate.hpp"
#include "core/estimate/sequential/drift_walk.hpp"
#include "core/plan/stretches_and_chains.hpp"
#include "core/sim/held_noise.hpp"
#include "core/sim/measurements.hpp"

namespace drift {
IntervalRows::IntervalRows(const FilterSpec& filter, const Timeline& timeline,
                           const Readout& readout)
    : filter_(filter),
      timeline_(timeline),
      readout_(readout),
      model_(filter.model()),
      layout_(make_layout(filter)),
      linearizer_(model_, layout_, readout),
      together_(all_in_lanes(model_.terms)),
      jacobians_(timeline, model_),
      memory_(timeline, model_),
      attitude_(layout_.size(), walking_states(filter, layout_),
                filter.noise.angle_random_walk > 0.0),
      rest_G_(padded_rows(layout_.num_rate)) {
  require_covariates(model_, timeline);
}

bool IntervalRows::strays() const {
  const double arw = filter_.noise.angle_random_walk;
  std::vector<double> walked(attitude_.walking().size(), 0.0);  // variances, in those of the priors
  double caged = 0.0, most = 0.0;
  for (std::size_t i = 0; i < timeline_.intervals.size(); ++i) {
    const Interval& interval = timeline_.intervals[i];
    if (interval.cage) caged = interval.t0;
    const double duration = interval.t1 - caged;
    most = std::max(most, arw * arw * duration);
    for (std::size_t k = 0; k < walked.size(); ++k) {
      const std::size_t state = attitude_.walking()[k];
      if (follows_a_recording(timeline_, i))
        walked[k] = variance_between_recordings(filter_, layout_, state, layout_.theta);
      walked[k] +=
          walk_variance(filter_, layout_, state, layout_.theta, time_since_before(timeline_, i));
      const double sigma = layout_.sigma[static_cast<Eigen::Index>(state)] * duration;  // [rad]
      most = std::max(most, arw * arw * duration + walked[k] * sigma * sigma);
    }
  }
  return most > std::pow(filter_.initial_attitude, 2);
}

void IntervalRows::reset(const Theta& theta) {
  theta_ = theta;
  linearizer_.set_theta(theta_);
  attitude_.reset();
}

void IntervalRows::set_theta(const Theta& theta) {
  if (memory_.active()) memory_.shift(theta_.data(), theta.data());
  theta_ = theta;
  linearizer_.set_theta(theta_);
}

const StepMemory* IntervalRows::enter(std::size_t i) {
  memory_.advance(i, theta_.data());
  return memory_.steps();
}

void IntervalRows::look_ahead(std::size_t first, std::size_t end, const Vec3* path) {
  if (together_) jacobians_.evaluate(first, end, path, linearizer_);
}

void IntervalRows::cage(const Interval& interval, const Vec3& phi) {
  const Node& node = timeline_.nodes[interval.first_node];
  attitude_.cage(node.R_il * (node.R_lr * -phi), filter_.initial_attitude);
}

void IntervalRows::take_triple(Channel channel, const AttitudeFilter::Scalars& scalars,
                               const AttitudeFilter::Gate* gate, double* rows, Taken& taken) {
  if (!taken.ok) return;
  double* into = rows + 3 * taken.triples * width();
  const auto used = attitude_.update(scalars, gate, into);
  taken.ok = used.has_value();
  taken.scalars += used.value_or(0);
  taken.channel[taken.triples++] = channel;
}

IntervalRows::Taken IntervalRows::take(std::size_t i, const Vec3& acc, const Vec3& gimbal,
                                       const Vec3* path, const AttitudeFilter::Gate* gate,
                                       double* rows) {
  const Interval& interval = timeline_.intervals[i];
  Taken taken;
  const MemoryPoint* memory = memory_.points();
  const Vec3* phi = path + interval.first_node;
  if (together_)
    propagate_sensitivity(interval, timeline_, jacobians_.of(i), sensitivity_);
  else
    linearize_interval(interval, timeline_, misalignment_matrix(model_.mounting, interval.loop),
                       phi, memory, linearizer_, sensitivity_);
  const std::size_t last = interval.node_count() - 1;
  const auto middle = static_cast<std::size_t>(interval.substeps);
  const double arw = filter_.noise.angle_random_walk;
  const double variance = arw * arw / interval.length();  // [rad^2/s^2]
  HeldNoise held;
  if (arw > 0.0) {
    held = held_noise(interval, timeline_);
    attitude_.hold(variance);
  }
  for (std::size_t k = 0; k < attitude_.walking().size(); ++k) {
    const std::size_t state = attitude_.walking()[k];
    if (follows_a_recording(timeline_, i))
      attitude_.walk_anew(k, variance_between_recordings(filter_, layout_, state, theta_));
    attitude_.walk(k,
                   walk_variance(filter_, layout_, state, theta_, time_since_before(timeline_, i)));
  }
  const Mat3& Phi_m = sensitivity_.Phi[middle];
  attitude_.propagate(Phi_m, sensitivity_.G[middle], held.to_middle);
  if (readout_.accelerometers && acc.array().isFinite().any()) {
    mean_output(interval, sensitivity_, mean_);
    taken.ok = mean_.acc.allFinite();  // what is not finite in nu is what was not measured
    take_triple(accelerometers,
                {acc - mean_.acc, mean_.H, &mean_.H_rate, &mean_.H_par, layout_.num_rate,
                 interval.accelerometer_noise(readout_.accelerometer_noise), &held.beside},
                gate, rows, taken);
  }
  const Mat3 Phi_rest = sensitivity_.Phi[last] * Phi_m.inverse();
  rest_G_ = sensitivity_.G[last];
  sum_of_products<Sum::onto>({-Phi_rest}, {&sensitivity_.G[middle]}, rest_G_);
  attitude_.propagate(Phi_rest, rest_G_, held.from_middle);
  if (arw > 0.0) attitude_.disturb(variance * held.anew * held.anew.transpose());
  if (readout_.gimbals && gimbal.array().isFinite().any()) {
    const GimbalPrediction predicted =
        interval.rest
            ? predict_rest_rate(interval, timeline_, phi, sensitivity_)
            : linearizer_.gimbals(timeline_, {&timeline_.nodes[interval.last_node()], &interval,
                                              phi[last], memory ? memory + 2 * last : nullptr});
    taken.ok = taken.ok && predicted.angles.allFinite();
    Vec3 residual;
    for (int k = 0; k < 3; ++k) residual[k] = angle_difference(gimbal[k], predicted.angles[k]);
    take_triple(gimbals,
                {residual, predicted.H, &predicted.H_rate, &predicted.H_par, layout_.num_rate,
                 interval.gimbal_noise(readout_.gimbal_noise)},
                gate, rows, taken);
  }
  return taken;
}

}  // namespace drift
