#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/linalg.hpp"
#include "core/base/named.hpp"
#include "core/base/units.hpp"
#include "core/plan/attitude/axis_turn.hpp"

namespace drift {

/// What the gyros are told during a dwell.
enum class CommandLaw {
  free,   ///< nothing: the platform holds inertial space
  level,  ///< the Earth rate at the nominal attitude: the platform keeps its attitude to gravity
};
inline constexpr Named<CommandLaw> command_laws[] = {{"free", CommandLaw::free},
                                                     {"level", CommandLaw::level}};
constexpr std::string_view key_of(CommandLaw law) {
  return name_in(command_laws, law);
}

/// How the platform comes to a position.
enum class Entry {
  caged,    ///< attitude set anew through the resolvers: unknown within the prior
  torqued,  ///< slewed there by gyro commands: the attitude error is carried along
};
inline constexpr Named<Entry> ways_of_entry[] = {{"caged", Entry::caged},
                                                 {"torqued", Entry::torqued}};
constexpr std::string_view key_of(Entry entry) {
  return name_in(ways_of_entry, entry);
}

/// One position of a test: an attitude at the start of a dwell, and the dwell.
struct Position {
  std::string name;
  std::string axes;              ///< "x=N y=W z=U", as given
  std::vector<AxisTurn> turns;   ///< of the platform from there, in order
  Mat3 R_lp = Mat3::Identity();  ///< nominal attitude at the start of the dwell, v_l = R_lp v_p
  double dwell = 3600.0;         ///< [s]
  double sample = 60.0;          ///< sample interval of dwell and slew [s]
  CommandLaw mode = CommandLaw::free;
  Entry entry = Entry::caged;
  std::optional<double> case_heading;  ///< of the case during the dwell [rad]; empty: chosen so
                                       ///< that the middle gimbal stays below 60 deg
};

/// A platform test.
struct TestPlan {
  std::string preset;  ///< empty if the positions are given one by one
  std::vector<Position> positions;
  double slew_rate = 0.5 * detail::deg;  ///< of a torqued entry [rad/s]
  double case_rate = 1.0 * detail::deg;  ///< of the turntable between two headings [rad/s]
};

/// What a preset leaves open.
struct PlanDefaults {
  double dwell = 3600.0;           ///< [s]
  double sample = 60.0;            ///< [s]
  std::optional<CommandLaw> mode;  ///< empty: the preset's own (free)
  std::optional<Entry> entry;      ///< empty: the preset's own
};

/// Names of all presets, for messages.
extern const std::vector<std::string_view> preset_names;

/// The positions of a preset: six, twelve, twentyfour, apollo10, eighteen, slew12, casespin
/// (physics.md 3.3). Empty if there is no such preset.
std::optional<TestPlan> preset_plan(std::string_view name, const PlanDefaults& defaults);

/// Reads "x=N y=W z=U": the local direction (N S E W U D, or two letters for the 45-deg direction
/// between them) of each platform axis. Empty, with the reason in `why`, if it is no right-handed
/// frame.
std::optional<Mat3> parse_axes(std::string_view text, std::string& why);

/// The attitude of a position as people read it: "x=N y=W z=U, 10 deg about y".
std::string attitude_text(const Position& position);

}  // namespace drift
