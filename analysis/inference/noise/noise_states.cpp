#include "analysis/inference/noise/noise_states.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace drift::inference {

namespace {

int others(int state) {
  return state - 3;
}

}  // namespace

NoiseSteps::NoiseSteps(const NoiseStates& states, const NoiseModel& noise) : s_(states), n_(noise) {
  if (s_.white < 0) return;
  NoiseStep& first = halves_[0].step;  // a new value, which acts at once
  first.kicked = true;
  first.decay.segment<3>(others(s_.white)).setZero();
  first.variance.segment<3>(others(s_.white)).setOnes();
}

void NoiseSteps::pass(NoiseStep& step, double time) const {
  const auto process = [&](int state, int count, double tau) {
    const double phi = std::isinf(tau) ? 1.0 : std::exp(-time / tau);
    step.decay.segment(others(state), count).setConstant(phi);
    step.variance.segment(others(state), count)
        .setConstant(std::isinf(tau) ? time : 1.0 - phi * phi);
  };
  if (s_.walk >= 0) process(s_.walk, 3, std::numeric_limits<double>::infinity());
  if (s_.markov >= 0) process(s_.markov, 3, n_.markov_tau);
  if (s_.acc >= 0) process(s_.acc, 3, n_.acc_tau);
  if (s_.lone >= 0) process(s_.lone, 1, n_.lone.tau);
}

void NoiseSteps::drive(NoiseStep& step, const IntervalDrive& d, bool first_half) const {
  const Mat3 part = 0.5 * d.per_rate * n_.gyros.asDiagonal();
  if (s_.white >= 0) {
    const Mat3 half = part * (n_.angle_random_walk / std::sqrt(d.length));  // of a value held
    if (first_half) {
      step.kick = 2.0 * std::numbers::inv_sqrt3 * half;
    } else {
      step.drive.middleCols<3>(others(s_.white)) = std::numbers::inv_sqrt3 * half;
      step.anew = half;
    }
  }
  if (s_.walk >= 0) step.drive.middleCols<3>(others(s_.walk)) = part * n_.drift_random_walk;
  if (s_.markov >= 0) step.drive.middleCols<3>(others(s_.markov)) = part * n_.markov_drift;
  if (s_.caging >= 0) step.drive.middleCols<3>(others(s_.caging)) = part * n_.caging_drift;
  if (s_.lone >= 0 && n_.lone.equation == Equation::rate)
    step.drive.col(others(s_.lone)) = 0.5 * n_.lone.sigma * d.per_rate.col(n_.lone.axis);
}

const NoiseStep& NoiseSteps::of(const IntervalDrive& d, bool first_half) {
  Half& half = halves_[first_half ? 0 : 1];
  const double time = 0.5 * d.length + (first_half ? d.gap : 0.0);
  if (time != half.time) pass(half.step, half.time = time);
  drive(half.step, d, first_half);
  return half.step;
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
