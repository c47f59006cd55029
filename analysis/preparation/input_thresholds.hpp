#pragma once

#include <cstddef>
#include <numbers>

#include "core/plan/attitude_slips.hpp"
#include "core/stats/normal.hpp"

/// Every number by which recordings, plan and site are judged before a fit; those of the diagnosis
/// are in analysis/inference/thresholds.hpp, which says how to read them. Tests are those of
/// Prepare and OddInput.
namespace drift::preparation {

/// What is left out, bridged, averaged or refused.
struct RecordingLimits {
  /// A sensor that stands at one value for so many samples, and so many times as long as it usually
  /// does, is stuck. Tuned on a coarse readout, which repeats a value often.
  /// Test: StuckSensor.*
  static constexpr std::size_t stuck = 20;
  /// Expected number of runs of equal readings, of those that chance makes of a channel, that are
  /// taken for a stuck sensor: one channel of 10 000 recordings has one. Readings of normal noise
  /// in steps repeat once more sqrt(2) times as often as they repeat at all, at most. Test:
  /// StuckSensor.*
  static constexpr double stuck_by_chance = 1e-4, once_more = std::numbers::sqrt2;
  /// Gaps that gimbal angles cannot close before the angles are doubted: two may be chance.
  static constexpr std::size_t odd_gaps = 3;
  /// Part by which sample intervals may differ from the plan's, and from each other. Tuned.
  /// Test: Prepare.SampleIntervalsMayDiffer...
  static constexpr double interval_room = 0.05;
  /// Part from which on that is said: a clock that is off by it makes every rate wrong by as much.
  /// Test: Prepare.AClockThatIsOffByAPerMilleIsSaid
  static constexpr double interval_said = 5e-4;
  /// Part by which the intervals of several evenly spaced recordings may differ to be one interval.
  static constexpr double same_interval = 1e-3;
  /// Rows beyond which samples are averaged, and the samples that the shortest dwell must keep. The
  /// time of a diagnosis grows with rows, what averages know does not: a platform in free drift
  /// takes minutes to move by more than its noise. Eight samples still show a slope beside noise.
  static constexpr std::size_t most_rows = 1500;
  static constexpr double kept_samples = 8.0;
  /// By which joined rows at several distances grow until they are few enough.
  static constexpr double coarser = 1.5;
  static constexpr std::size_t longest_gap = 100000;  ///< [rows] of one gap that are looked through
  /// [rad/s] by which the command may differ on both sides of a gap: rounding of a text file.
  static constexpr double gap_command = 1e-9;
  /// [rows] by which the time of a change of command, read off the gimbals, may miss that of a row:
  /// above that it is nearer to no row than to one. Test: UnequalRows.*
  static constexpr double change_room = 0.3;
  /// [rows] by which the begin of a dwell as planned may miss a row, and the rows that may be
  /// missing at its begin.
  static constexpr double grid_room = 0.1, first_rows = 5.0;
  /// [rms of the jitter] by which what is usual may miss the plan's sample and be it.
  static constexpr double hidden = 2.0;
  /// [sigma] that the uncertain begin of a row may add to its accelerometers under Earth rate.
  static constexpr double begin_noise = 0.2;
};

/// When accelerometers are in another unit than they say.
struct GravityLimits {
  /// Part by which the specific force at rest may be longer or shorter than 1 g: 100 sigma of the
  /// library's priors of bias and scale (500 ug, 500 ppm), and far more than gravity differs on
  /// Earth (0.4 %). Units differ by a factor of 3 or more. Test: GravityCheck.*
  static constexpr double room = 0.05;
  static constexpr double sigmas = 5.0;     ///< of the study's own priors, beyond that
  static constexpr std::size_t enough = 5;  ///< [rows] fewer say nothing, of all or of a position
  /// Part by which they may be off at rest on a case: 100 mg of bias and 5 % of scale, as bought.
  static constexpr double on_a_case = 0.15;
  /// Factor between units, at least: ft/s^2 and m/s^2 differ by 3.3. Test: CaseStudy.OneAccel...
  static constexpr double units_differ = 3.0;
  /// By how many times the specific force must be larger in one rest than in another to be of an
  /// attitude: with biases and scales as above it is 1.4 at most.
  static constexpr double by_attitude = 2.0;
};

/// What a logger writes where it has read nothing. Of readings that move, one number to the last
/// digit comes back in other positions by chance only where they are rounded, and then its
/// neighbours are near. Test: Fillers.*
struct FillerLimits {
  static constexpr std::size_t rows = 3, positions = 2;  ///< in which the number stands
  /// How far its neighbours are, at least: as an attitude from that of the plan [rad], and what
  /// turns Up by as much [g]. A platform in free drift takes 40 minutes for that. A covariate: as
  /// far as it may well be from its mean (CovariateSpec::usual), 10 degC, a fast chamber's two
  /// minutes; of a field, its size.
  static constexpr double angle = largest_mismatch, force = largest_mismatch;
};

/// Rows that all sensors repeat. Test: HeldRows.*
struct HeldLimits {
  /// Expected number of rows in which all do by chance, at most: in one recording of 1000 there is
  /// one.
  static constexpr double chance = 1e-3;
  /// Part of the rows beyond which the log is faster than its sensors.
  static constexpr double most = 0.1;
};

/// Single readings among fine rows that are none, before rows are joined. Test: RawSpikes.*
struct RawSpikeLimits {
  /// [sigma] from the median of four neighbours, and ranges of them on top of it, without the
  /// farthest: as SampleLimits of analysis/inference has it of residuals, of normal noise one in
  /// 4e11 readings. Steps of a coarse readout count as a sigma.
  static constexpr double size = 8.0, spread = 2.0;
  /// Part of a channel's readings: of more than that the noise is not normal, and none is left out.
  static constexpr double most = 0.02;
  /// Readings of which the noise is known to 12 % (1 sigma): fewer do not tell; and of how many at
  /// most it is taken.
  static constexpr std::size_t enough = 100, of_noise = 100000;
};

/// When a gimbal reads a constant too much.
struct GimbalZeroLimits {
  /// [of what biases and misalignments make of Up, 1 sigma: 0.06 deg with the library's priors] so
  /// large a zero is of no unit as its priors say (6e-7), nor is what leaves so much (3e-7).
  /// Test: GimbalZero.*
  static constexpr double least = 5.0, left = 5.0;
  static constexpr double clearly = 2.0;  ///< times as much is left by every other gimbal
  /// Chance of what a change of sign takes away, if that is of no sign. In six positions a quarter
  /// may be left. Test: GimbalSign.*
  static constexpr double sign_by_chance = stats::beyond_5_sigma;
  static constexpr std::size_t positions = 3;  ///< fewer fit several guesses
  static constexpr double shown = 0.05;        ///< part of a zero that Up must show, squared, mean
};

/// When a plan is not that of the recording.
struct PlanLimits {
  /// [samples] by which a dwell may be longer or shorter. Test: Prepare.ADwellTwoSamplesShortIsSaid
  static constexpr double dwell = 1.5;
  /// [deg/h] from the law's command: a fifteenth of Earth rate; compensated drift may be more and
  /// is remarked then.
  /// Test: Prepare.ACommandOneDegPerHour...
  static constexpr double command_deg_per_h = 1.0;
  /// Of that: how near a command must be to Earth rate in the meridian to be that of a latitude,
  /// and how far from the site's for it to be another one (0.04 deg at Earth rate).
  static constexpr double meridian = 0.02, latitude = 0.01;
  /// Of what a factor on the commands makes of them: how much may be left beside it. And the part
  /// by which a factor may miss that of a unit; the nearest two (60 and 57.3) differ by 4.5 %.
  /// Test: CommandCheck.*
  static constexpr double factor_left = 0.05, unit_room = 0.02;
  static constexpr double scale_sigmas =
      5.0;  ///< of the study's own prior: a factor beyond is told
  /// Without recorded commands: part of the difference of both laws within which the platform moves
  /// by the other one, and [deg/h] below which drift could look like that difference (the prior of
  /// drift is 1 deg/h).
  static constexpr double other_law = 0.4, laws_differ_deg_per_h = 5.0;
  /// [rad] by which the platform may turn from one row to the next within a position, and [rad/s]
  /// more with the time between them: twice the Earth's rate. Rows on both sides that must be
  /// there: fewer are numbers that change late. Test: Prepare.TwoPositionsUnderOneNumber...
  static constexpr double turned = 0.3, drifted = 1.5e-4;
  static constexpr std::size_t rows_beside_a_turn = 4;
  /// [s] over which a rotation is read off: 15 deg of the Earth's, where it still is a vector.
  static constexpr double longest_turn = 3600.0;
};

/// When times are in another unit than they say.
struct ClockLimits {
  /// Times the Earth's rate, or one part of that, at which a free platform does not turn: its drift
  /// would be 100 sigma of the library's priors (D_F 1, D_I 2 deg/h), or cancel the Earth's rate to
  /// a twentieth. Test: ClockUnit.*
  static constexpr double nothing_like = 20.0;
  /// Times the Earth's rate at which Up must turn then, too: a part cos(latitude) of the whole, a
  /// twentieth at 87 deg.
  static constexpr double up_turns = 3.0;
  static constexpr double alike = 1.5;   ///< factor by which drift may move it from a unit's
  static constexpr double steady = 3.0;  ///< factor between the halves of a rest that it is not
  static constexpr double no_command = 1e-9;  ///< [rad/s], rounding of a text file
};

/// When the Earth's rate about Up, as the gyros of a unit on a case read it at rest, tells the unit
/// from its mirror image. Test: GyroSigns.*
struct MirrorLimits {
  /// Five leave three drifts and the rate one residual, whose scatter 5 sigma pass by chance with
  /// 0.13; six, with two, 0.04.
  static constexpr std::size_t rests = 6;
  static constexpr double sigmas = 5.0;  ///< of what is read, that the Earth's rate must be
  /// Part of it by which what is read may miss it: nearer to one of the two than to none. Drift
  /// with the input axis that the three have alike is read as well.
  static constexpr double room = 0.5;
};

/// When the gyros of a unit on a case are read in another unit, or with the other sign. Chances are
/// worked out in strapdown/gyro_unit.hpp. Test: CaseStudy.GyrosInAnotherUnit...
struct GyroUnitLimits {
  /// [rad] that gravity must turn from rest to rest: 10 deg, of which scale and axes that are wrong
  /// by 5 % leave a tenth at most.
  static constexpr double least_turn = 0.1745;
  static constexpr std::size_t fewest_turns = 3;  ///< so that one bad turn has no median
  /// Median error, in parts of the turn, of the right unit. A wrong one may come near where a turn
  /// is nearly whole (57 times 90 deg is 117 deg), so what is right must be far better.
  static constexpr double alike = 0.1, far_better = 0.2;
  static constexpr double nothing_like = 0.5;  ///< error of a turn about a column that is wrong
};

}  // namespace drift::preparation
