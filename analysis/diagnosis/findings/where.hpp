#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace drift::diagnosis {

/// A part of the misfit that the nominal model leaves: `share` of what the cause or the period
/// explains falls on it; where nothing explains it, of the excess of chi-square over the rows.
/// Shares of all parts sum to 1. z: studentised excess of its mean square over 1.
struct Share {
  std::string name = {};  ///< "acc_y", "gimbal_middle"; empty for positions
  int position = 0;       ///< 1-based; 0 for channels
  double share = 0.0, sigma = 0.0;
  double chi2_per_dof = 1.0, z = 0.0;
};

/// One cell of the heat map channel x position.
struct HeatCell {
  int position = 0;    ///< 1-based
  int channel = 0;     ///< index into Where::channel_names
  double share = 0.0;  ///< as Share::share, signed
  double chi2_per_dof = 1.0;
};

/// Outcome of one window of the location scan: a unit box in one equation, position and window.
struct ScanHit {
  std::string
      equation;      ///< "platform rate y", "attitude offset y", "accelerometer x", "gimbal outer"
  int position = 0;  ///< 1-based
  double start_s = 0.0, end_s = 0.0;
  double T = 0.0;                       ///< projected score, chi-square of one degree
  double p_value = 1.0;                 ///< family-wise over the scan
  double amplitude = 0.0, sigma = 0.0;  ///< of the box [rad/s, rad, g, rad by equation]
};

/// Where one of several recordings lies in the timeline that they make one after another.
struct RecordingSpan {
  std::string name;
  double start_s = 0.0, end_s = 0.0;
  double offset_s = 0.0;  ///< time of the timeline less the recording's own
};

struct Where {
  std::vector<std::string> channel_names;  ///< acc_x y z, gimbal_outer middle inner
  std::vector<Share> channels, positions;  ///< largest share first
  std::vector<HeatCell> heat;
  /// Significant ones, strongest first, overlapping ones once; of causes that are named the time in
  /// which they act, none where that is always.
  std::vector<ScanHit> windows;
  /// Of the first cause that is named, else of the strongest input of free form; empty if nothing
  /// is significant.
  std::string equation;
  std::vector<std::string> equations;  ///< of every cause that is named, each once
  double onset_s = std::numeric_limits<double>::quiet_NaN();  ///< of a cause that sets in once
  double scan_p_value = 1.0;                                  ///< family-wise over all windows
  std::size_t windows_tried = 0;
  std::vector<RecordingSpan> recordings;  ///< in order, of several; empty of one
};

}  // namespace drift::diagnosis
