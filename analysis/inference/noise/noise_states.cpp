#include "analysis/inference/noise/noise_states.hpp"

#include <cmath>

namespace drift::inference {

NoiseStep step_of(const NoiseStates& s, const NoiseModel& n, const IntervalDrive& d,
                  bool first_half) {
  const double dt = 0.5 * d.length, gap = first_half ? d.gap : 0.0;
  NoiseStep step{OverPairs::Identity(s.count, s.count), OverPairs::Zero(s.count, s.count)};
  const Mat3 part = 0.5 * d.per_rate * n.gyros.asDiagonal();
  if (s.white >= 0) {
    const Mat3 kick = part * (n.angle_random_walk / std::sqrt(d.length));
    if (first_half) {  // a new value, which acts at once
      step.F.block<3, 3>(s.white, s.white).setZero();
      step.Q.block<3, 3>(s.white, s.white).setIdentity();
      step.Q.block<3, 3>(0, s.white) = kick;
      step.Q.block<3, 3>(s.white, 0) = kick.transpose();
      step.Q.topLeftCorner<3, 3>() = kick * kick.transpose();
    } else {
      step.F.block<3, 3>(0, s.white) = kick;
    }
  }
  if (s.walk >= 0) {
    step.F.block<3, 3>(0, s.walk) = part * n.drift_random_walk;
    step.Q.block<3, 3>(s.walk, s.walk) = (dt + gap) * Mat3::Identity();
  }
  if (s.markov >= 0) {
    const double phi = std::exp(-(dt + gap) / n.markov_tau);
    step.F.block<3, 3>(0, s.markov) = part * n.markov_drift;
    step.F.block<3, 3>(s.markov, s.markov) = phi * Mat3::Identity();
    step.Q.block<3, 3>(s.markov, s.markov) = (1.0 - phi * phi) * Mat3::Identity();
  }
  if (s.acc >= 0) {
    const double phi = std::exp(-(dt + gap) / n.acc_tau);
    step.F.block<3, 3>(s.acc, s.acc) = phi * Mat3::Identity();
    step.Q.block<3, 3>(s.acc, s.acc) = (1.0 - phi * phi) * Mat3::Identity();
  }
  if (s.lone >= 0) {
    const bool walks = std::isinf(n.lone.tau);
    const double phi = walks ? 1.0 : std::exp(-(dt + gap) / n.lone.tau);
    step.F(s.lone, s.lone) = phi;
    step.Q(s.lone, s.lone) = walks ? dt + gap : 1.0 - phi * phi;
    if (n.lone.equation == Equation::rate)
      step.F.block<3, 1>(0, s.lone) = 0.5 * n.lone.sigma * d.per_rate.col(n.lone.axis);
  }
  return step;
}

double lone_weight(const MeasuredRows& p, const LoneInput& lone, const RowTag& row) {
  if (lone.equation == Equation::accelerometer && row.channel == lone.axis)
    return lone.sigma / p.acc_sigma_of(row);
  if (lone.equation == Equation::gimbal && row.channel == 3 + lone.axis)
    return lone.sigma / p.gimbal_sigma;
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
