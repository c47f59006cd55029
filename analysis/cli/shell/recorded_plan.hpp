#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/planning/shown_attitude.hpp"
#include "core/recording/recording.hpp"

namespace drift::cli {

/// What a recording says of the plan it was made on.
struct RecordedPlan {
  struct Position {
    double length = 0.0;                 ///< of the dwell [s], a whole number of its samples
    planning::ShownAttitude attitude{};  ///< at its beginning
    bool torqued = false;                ///< slewed to, as the phases say
    bool level = false;                  ///< Earth rate is commanded in the dwell
    std::optional<double> heading{};     ///< of the case [rad], where it is recorded
    /// If the case was 45 deg further; without axes: less likely.
    planning::ShownAttitude turned{};
    std::optional<double> sample{};  ///< of its own [s], where it is not that of the plan
  };
  double sample = 0.0;    ///< of most rows of the dwells [s]
  bool level = false;     ///< Earth rate is commanded in most dwells
  bool north = false;     ///< the axes that lie level are from gimbal angles
  bool headings = false;  ///< and the headings of the case are recorded; else it faces North
  /// Heading of a case whose headings are not recorded [rad]: what brings the gimbals of all
  /// positions to plain axes, to the nearest of eight directions.
  double faces = 0.0;
  bool to_come = false;         ///< the recording could not be read yet: the positions hold a place
  std::string noise{};          ///< accelerometer_noise of [readout] as its rests show it; or empty
  std::string gimbal_noise{};   ///< the same of the gimbals
  std::string contradiction{};  ///< of accelerometers and gimbals, in words; empty: none
  std::vector<Position> positions{};

  /// [s] That of the first position, in whole samples of the plan: for all of them alike.
  double common_dwell() const;
};

/// Dwells, samples and attitudes of a platform's recording: from the gimbal angles at the beginning
/// of each dwell, or, without them, what is up from the accelerometers.
RecordedPlan recorded_plan(const Recording& recording);

/// As many positions, all alike, as a recording names that cannot be read yet.
RecordedPlan plan_to_come(std::size_t positions);

/// Where a recording says that it was made ("45.75 deg", "9.8067 m/s^2"), as `convert` notes it or
/// as it stands above the header.
struct RecordedSite {
  std::optional<std::string> latitude, gravity;
  std::string latitude_place{}, gravity_place{};  ///< "'log.txt':3"; empty: a fact
  bool divides = false;  ///< gravity: the accelerometers of the recording are in m/s^2
};
RecordedSite recorded_site(const Recording& recording);

}  // namespace drift::cli
