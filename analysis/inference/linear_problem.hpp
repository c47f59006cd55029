#pragma once

#include <cmath>
#include <vector>

#include "core/base/linalg.hpp"

namespace drift::inference {

/// acc x y z, gimbal outer middle inner; of a strapdown unit the gyros at rest in place of these.
inline constexpr int num_channels = 6;

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
/// back through the linearised dynamics, as the rows' derivatives with respect to the attitude at
/// caging go forward.
struct IntervalDrive {
  double length = 0.0;  ///< [s]
  double gap = 0.0;     ///< time since the end of the interval before [s]
  bool cage = false;
  bool begins = false;  ///< a recording (Interval::begins), with all noise anew
  bool rest = false;    ///< nothing moves the attitude; the gyros are measured (Interval::rest)
  int chain = 0;
  double samples = 1.0;          ///< that the accelerometers average (Interval)
  double readings = 1.0;         ///< of the gimbals, likewise
  Mat3 per_rate = Mat3::Zero();  ///< d attitude / d gyro drift over the interval [1/(rad/s)]
};

/// What was measured, row by row, and how noise reaches it. Rows are in time order and in units of
/// the declared sigma.
struct MeasuredRows {
  std::vector<RowTag> tags;           ///< of every row
  std::vector<IntervalDrive> drives;  ///< of every interval
  MatX psi;     ///< shape (rows, 3): d row / d attitude at the caging of its chain
  VecX r0;      ///< shape rows: measured minus predicted at the prior mean, by the linearisation
  VecX weight;  ///< shape rows: 1, or less for a row that is not trusted (sigma / weight)
  double acc_sigma = 1.0, gimbal_sigma = 1.0;         ///< declared of one sample [g], [rad]
  bool acc_rounded = false, gimbals_rounded = false;  ///< that is known (Readout)
  bool driven_at_most = false;                        ///< Readout::gimbal_noise_at_most
  double attitude_sigma = 1.0;                        ///< unit of psi [rad]

  Eigen::Index rows() const { return r0.size(); }
  /// What a gyro's drift adds to a row at rest that reads it [1/(rad/s)]; 0 in other rows.
  double per_drift(const RowTag& row, int gyro) const {
    return drives[row.interval].rest && row.channel == 3 + gyro ? -1.0 / gimbal_sigma : 0.0;
  }
  /// 1 sigma declared of an accelerometer row [g].
  double acc_sigma_of(const RowTag& row) const {
    return acc_sigma / std::sqrt(drives[row.interval].samples);
  }
  /// 1 sigma declared of a gimbal row [rad].
  double gimbal_sigma_of(const RowTag& row) const {
    return gimbal_sigma / std::sqrt(drives[row.interval].readings);
  }
};

/// The linearised test about a fit: r0 = J x + sum_c s_c a_c + noise, with theta's x ~ N(0, I).
/// x in prior sigmas, a likewise.
struct LinearProblem : MeasuredRows {
  MatX theta;  ///< shape (rows, n): J
  MatX extra;  ///< shape (rows, K): candidate signatures s

  /// With some candidates in the mean: their columns are parameters too, a ~ N(0, I). All of them
  /// are still listed as candidates, so that their numbers hold.
  LinearProblem with_mean(const std::vector<int>& columns) const;
  /// The same without the others.
  LinearProblem with_mean_alone(const std::vector<int>& columns) const;
  /// Without candidates.
  LinearProblem bare() const;
  /// Without the rows of the intervals that are marked.
  LinearProblem without(const std::vector<bool>& intervals) const;
};

}  // namespace drift::inference
