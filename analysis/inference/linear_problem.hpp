#pragma once

#include <limits>
#include <string>
#include <vector>

#include "core/base/linalg.hpp"

namespace drift::inference {

inline constexpr int num_channels = 6;  ///< acc x y z, gimbal outer middle inner

/// Which measured scalar a row is, and what process noise may have moved before it.
struct RowTag {
  std::size_t interval = 0;  ///< index in the timeline
  int channel = 0;           ///< 0..2 accelerometers, 3..5 gimbals
  int position = 0;          ///< from 0
  bool accelerometer() const { return channel < 3; }
};

/// How noise drives the attitude within one interval, before its first row.
///
/// Attitude errors are counted at the caging (in prior sigmas): noise that comes later is carried
/// back, so that a row's derivative with respect to the attitude at caging is its H. The platform
/// holds inertial space to first order, so the way back is the identity (error: A t, a few
/// percent).
struct IntervalDrive {
  double length = 0.0;  ///< [s]
  double gap = 0.0;     ///< time since the end of the interval before [s]
  bool cage = false;
  int chain = 0;
  Mat3 per_rate = Mat3::Zero();  ///< d attitude / d gyro drift over the interval [1/(rad/s)]
};

/// The linearised test about a fit: r0 = J x + sum_c s_c a_c + noise, with theta's x ~ N(0, I).
/// Rows are in time order and in units of the declared sigma; x in prior sigmas, a likewise.
struct LinearProblem {
  std::vector<RowTag> tags;           ///< of every row
  std::vector<IntervalDrive> drives;  ///< of every interval
  MatX psi;     ///< shape (rows, 3): d row / d attitude at the caging of its chain
  MatX theta;   ///< shape (rows, n)
  MatX extra;   ///< shape (rows, K): candidate signatures
  VecX r0;      ///< shape rows: measured minus predicted at the prior mean, by the linearisation
  VecX weight;  ///< shape rows: 1, or less for a row that is not trusted (sigma / weight)
  double acc_sigma = 1.0, gimbal_sigma = 1.0;  ///< declared [g], [rad]
  double attitude_sigma = 1.0;                 ///< unit of psi [rad]

  Eigen::Index rows() const { return r0.size(); }
};

/// Something unknown, of free form, in one equation alone: a first-order Markov process; with
/// infinite tau a random walk from zero.
struct LoneInput {
  enum class Equation {
    rate,
    accelerometer,
    gimbal
  };  ///< gyro drift, error of an accelerometer, of a resolver
  Equation equation = Equation::rate;
  int axis = 0;
  double sigma =
      0.0;  ///< stationary [rad/s, g, rad]; of a random walk per sqrt(s). 0: there is none
  double tau = std::numeric_limits<double>::infinity();  ///< [s]
};

/// Standard deviations of all noise: white of the instruments, and what drives the platform.
struct NoiseModel {
  double acc_factor = 1.0, gimbal_factor = 1.0;  ///< white, over declared
  double angle_random_walk = 0.0;                ///< [rad/sqrt(s)]
  double drift_random_walk = 0.0;                ///< [rad/s/sqrt(s)]
  double markov_drift = 0.0;                     ///< stationary sigma of a gyro's drift [rad/s]
  double markov_tau = 1800.0;                    ///< [s]
  double acc_markov = 0.0;    ///< stationary sigma of correlated accelerometer noise [g]
  double acc_tau = 300.0;     ///< [s]
  Vec3 gyros = Vec3::Ones();  ///< weight of each gyro's share in what drives the platform
  LoneInput lone;             ///< beside what the instruments share

  bool driven() const {
    return angle_random_walk > 0.0 || drift_random_walk > 0.0 || markov_drift > 0.0 ||
           acc_markov > 0.0 || lone.sigma > 0.0;
  }
};

}  // namespace drift::inference
