#pragma once

#include <utility>

#include "analysis/inference/linear_problem.hpp"
#include "analysis/inference/noise/noise_model.hpp"

namespace drift::inference {

/// Where each kind of state stands; -1: not there.
struct NoiseStates {
  int white = -1, walk = -1, markov = -1, caging = -1, acc = -1, lone = -1, count = 3;

  explicit NoiseStates(const NoiseModel& n) {
    if (n.angle_random_walk > 0.0) white = std::exchange(count, count + 3);
    if (n.drift_random_walk > 0.0) walk = std::exchange(count, count + 3);
    if (n.markov_drift > 0.0) markov = std::exchange(count, count + 3);
    if (n.caging_drift > 0.0) caging = std::exchange(count, count + 3);
    if (n.acc_markov > 0.0) acc = std::exchange(count, count + 3);
    if (n.lone.sigma > 0.0) lone = std::exchange(count, count + 1);
  }
};

/// Over the states: at most the attitude, five kinds by three and a lone one; never on the heap.
inline constexpr int most_states = 19;
using OverStates = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_states, 1>;
using OverPairs =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_states, most_states>;

/// What one half of an interval does to the states: the attitude += drive others, each of the
/// others *= decay; then noise comes in.
struct NoiseStep {
  static constexpr int most_others = most_states - 3;
  using OverOthers = Eigen::Matrix<double, most_others, 1>;

  Eigen::Matrix<double, 3, most_others> drive = Eigen::Matrix<double, 3, most_others>::Zero();
  OverOthers decay = OverOthers::Ones();
  OverOthers variance = OverOthers::Zero();  ///< that each of the others gains
  bool kicked = false;  ///< a new value of the white rate noise, the first three of the others,
  Mat3 kick = Mat3::Zero();  ///< which acts on the attitude at once, by this
  Mat3 anew = Mat3::Zero();  ///< by a value that nothing before it feels, on the attitude
};

/// Steps of a noise, half interval after half interval. States are in units of their own sigma. Of
/// white rate noise the accelerometers feel the mean of an interval, the gimbals its end
/// (HeldNoise).
class NoiseSteps {
 public:
  NoiseSteps(const NoiseStates& states, const NoiseModel& noise);
  /// Valid until the next of the same half.
  const NoiseStep& of(const IntervalDrive& d, bool first_half);

 private:
  /// What the time says, which is seldom another than before.
  void pass(NoiseStep& step, double time) const;
  /// How much of a rate acts on the attitude.
  void drive(NoiseStep& step, const IntervalDrive& d, bool first_half) const;

  NoiseStates s_;
  NoiseModel n_;
  struct Half {
    NoiseStep step;
    double time = -1.0;  ///< [s] that step stands for
  } halves_[2];
};

/// A caging: what it adds to the drift is drawn anew.
NoiseStep caged(const NoiseStates& s);

/// Before anything is measured in a recording: attitude at its prior, a random walk at zero, the
/// others stationary.
OverPairs initial_covariance(const NoiseStates& s, const NoiseModel& n);

/// Weight of the lone input on a row: zero on those of other channels.
double lone_weight(const MeasuredRows& p, const LoneInput& lone, const RowTag& row);

/// What begins anew: a recording, with all states, or a chain, with its attitude.
enum class Anew { recording, chain };

/// Walks along intervals and rows; calls begin(what), move(step) and row(index, h, white sigma).
template <class Begin, class Move, class Row>
void walk(const MeasuredRows& p, const NoiseModel& n, const NoiseStates& s, Begin&& begin,
          Move&& move, Row&& row) {
  Eigen::Index k = 0;
  OverStates h(s.count);
  NoiseSteps steps(s, n);
  for (std::size_t i = 0; i < p.drives.size(); ++i) {
    const IntervalDrive& d = p.drives[i];
    if (d.begins || d.cage) begin(d.begins ? Anew::recording : Anew::chain);
    if (s.caging >= 0 && d.cage && !d.begins) move(caged(s));
    // Half of the interval's noise before its accelerometer rows, half before its gimbal rows.
    for (const bool accelerometer : {true, false}) {
      if (n.driven()) move(steps.of(d, accelerometer));
      for (; k < p.rows() && p.tags[k].interval == i && p.tags[k].accelerometer() == accelerometer;
           ++k) {
        h.setZero();
        h.head<3>() = p.psi.row(k);
        if (accelerometer && s.acc >= 0)
          h[s.acc + p.tags[k].channel] = n.acc_markov / p.acc_sigma_of(p.tags[k]);
        if (s.lone >= 0) h[s.lone] = lone_weight(p, n.lone, p.tags[k]);
        for (int gyro = 0; d.rest && gyro < 3; ++gyro) {
          const double by_drift = p.per_drift(p.tags[k], gyro) * n.gyros[gyro];
          if (s.walk >= 0) h[s.walk + gyro] = by_drift * n.drift_random_walk;
          if (s.markov >= 0) h[s.markov + gyro] = by_drift * n.markov_drift;
        }
        row(k, h, (accelerometer ? n.acc_factor : n.gimbal_factor) / p.weight[k]);
      }
    }
  }
}

}  // namespace drift::inference
