#pragma once

#include <cstddef>

/// Every number by which recordings, plan and site are judged before a fit; those of the diagnosis
/// are in analysis/inference/thresholds.hpp, which says how to read them. Tests are those of
/// Prepare and OddInput.
namespace drift::preparation {

/// What is left out, bridged, averaged or refused.
struct RecordingLimits {
  /// A sensor that stands at one value for so many samples, and so many times as long as it usually
  /// does, is stuck. Tuned on a coarse readout, which repeats a value often.
  /// Test: Prepare.TwentyEqualSamplesAreAStuckSensor
  static constexpr std::size_t stuck = 20;
  /// Part by which sample intervals may differ from the plan's, and from each other. Tuned.
  /// Test: Prepare.SampleIntervalsMayDiffer...
  static constexpr double interval_room = 0.05;
  /// Rows beyond which samples are averaged, and the samples that the shortest dwell must keep. The
  /// time of a diagnosis grows with rows; eight samples still show a slope beside noise. Tuned.
  static constexpr std::size_t most_rows = 20000;
  static constexpr double kept_samples = 8.0;
  /// A step in time that is a gap, in sample intervals: halfway to one missing row.
  static constexpr double gap = 1.5;
  static constexpr std::size_t longest_gap = 100000;  ///< [rows] that one gap may be filled with
  /// [rad/s] by which the command may differ on both sides of a gap: rounding of a text file.
  static constexpr double gap_command = 1e-9;
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
  /// Without recorded commands: part of the difference of both laws within which the platform moves
  /// by the other one, and [deg/h] below which drift could look like that difference (the prior of
  /// drift is 1 deg/h).
  static constexpr double other_law = 0.4, laws_differ_deg_per_h = 5.0;
  /// [s] over which a rotation is read off: 15 deg of the Earth's, where it still is a vector.
  static constexpr double longest_turn = 3600.0;
};

}  // namespace drift::preparation
