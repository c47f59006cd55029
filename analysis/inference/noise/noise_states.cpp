#include "analysis/inference/noise/noise_states.hpp"

#include <cmath>
#include <numbers>

namespace drift::inference {

NoiseStep step_of(const NoiseStates& s, const NoiseModel& n, const IntervalDrive& d,
                  bool first_half) {
  const double dt = 0.5 * d.length, gap = first_half ? d.gap : 0.0;
  NoiseStep step;
  const auto others = [](int state) { return state - 3; };
  const Mat3 part = 0.5 * d.per_rate * n.gyros.asDiagonal();
  if (s.white >= 0) {
    const Mat3 half = part * (n.angle_random_walk / std::sqrt(d.length));  // of a value held
    if (first_half) {  // a new value, which acts at once
      step.decay.segment<3>(others(s.white)).setZero();
      step.variance.segment<3>(others(s.white)).setOnes();
      step.kick = 2.0 * std::numbers::inv_sqrt3 * half;
      step.kicked = true;
    } else {
      step.drive.middleCols<3>(others(s.white)) = std::numbers::inv_sqrt3 * half;
      step.anew = half;
    }
  }
  if (s.walk >= 0) {
    step.drive.middleCols<3>(others(s.walk)) = part * n.drift_random_walk;
    step.variance.segment<3>(others(s.walk)).setConstant(dt + gap);
  }
  if (s.markov >= 0) {
    const double phi = std::exp(-(dt + gap) / n.markov_tau);
    step.drive.middleCols<3>(others(s.markov)) = part * n.markov_drift;
    step.decay.segment<3>(others(s.markov)).setConstant(phi);
    step.variance.segment<3>(others(s.markov)).setConstant(1.0 - phi * phi);
  }
  if (s.caging >= 0) step.drive.middleCols<3>(others(s.caging)) = part * n.caging_drift;
  if (s.acc >= 0) {
    const double phi = std::exp(-(dt + gap) / n.acc_tau);
    step.decay.segment<3>(others(s.acc)).setConstant(phi);
    step.variance.segment<3>(others(s.acc)).setConstant(1.0 - phi * phi);
  }
  if (s.lone >= 0) {
    const bool walks = std::isinf(n.lone.tau);
    const double phi = walks ? 1.0 : std::exp(-(dt + gap) / n.lone.tau);
    step.decay[others(s.lone)] = phi;
    step.variance[others(s.lone)] = walks ? dt + gap : 1.0 - phi * phi;
    if (n.lone.equation == Equation::rate)
      step.drive.col(others(s.lone)) = 0.5 * n.lone.sigma * d.per_rate.col(n.lone.axis);
  }
  return step;
}

NoiseStep caged(const NoiseStates& s) {
  NoiseStep step;
  step.decay.segment<3>(s.caging - 3).setZero();
  step.variance.segment<3>(s.caging - 3).setOnes();
  return step;
}

double lone_weight(const MeasuredRows& p, const LoneInput& lone, const RowTag& row) {
  if (lone.equation == Equation::accelerometer && row.channel == lone.axis)
    return lone.sigma / p.acc_sigma_of(row);
  if (lone.equation == Equation::gimbal && row.channel == 3 + lone.axis)
    return lone.sigma / p.gimbal_sigma_of(row);
  if (lone.equation == Equation::rate) return lone.sigma * p.per_drift(row, lone.axis);
  return 0.0;
}

OverPairs initial_covariance(const NoiseStates& s, const NoiseModel& n) {
  OverPairs P = OverPairs::Identity(s.count, s.count);
  if (s.walk >= 0) P.block<3, 3>(s.walk, s.walk).setZero();
  if (s.lone >= 0 && std::isinf(n.lone.tau)) P(s.lone, s.lone) = 0.0;
  return P;
}

}  // namespace drift::inference
