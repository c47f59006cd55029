#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "core/base/linalg.hpp"
#include "core/base/units.hpp"
#include "core/recording/recording.hpp"

namespace drift {

/// What a known channel measures (core/docs/recording.md).
struct ChannelQuantity {
  Unit unit;               ///< in which a number of it is told
  std::string_view words;  ///< "a specific force, for example [g], [mg] or [ug]"
  bool needs_unit = true;
  double most =
      1e300;  ///< largest plausible magnitude [internal unit]; beyond it something is wrong
};

/// The quantity of a channel the program knows by name; empty for a covariate of any dimension.
std::optional<ChannelQuantity> known_quantity(std::string_view name);

/// Channels that come as three axes or not at all.
struct ChannelTriple {
  std::string_view what;
  std::array<std::string_view, 3> names;
};
inline constexpr ChannelTriple accelerometer_channels{"accelerometers",
                                                      {"acc_x", "acc_y", "acc_z"}};
inline constexpr ChannelTriple gimbal_channels{"gimbal angles",
                                               {"gimbal_outer", "gimbal_middle", "gimbal_inner"}};
inline constexpr ChannelTriple command_channels{"commanded rates", {"cmd_x", "cmd_y", "cmd_z"}};
inline constexpr ChannelTriple gyro_channels{"gyros", {"gyro_x", "gyro_y", "gyro_z"}};
inline constexpr std::array<ChannelTriple, 4> channel_triples{
    accelerometer_channels, gimbal_channels, command_channels, gyro_channels};

/// What a loop of coupling "compensated" removed: eta and xi of the gyros.
inline constexpr std::array<std::string_view, 6> loop_channels{
    "loop_eta_x", "loop_eta_y", "loop_eta_z", "loop_xi_x", "loop_xi_y", "loop_xi_z"};

/// Three channels of a row as a vector [internal units]; empty where one of them is absent or not
/// measured.
std::optional<Vec3> measured(const Recording& recording, const ChannelTriple& channels,
                             std::size_t row);

/// Whether a channel is an angle: of a gimbal, or the heading of the case.
bool is_angle(std::string_view name);

/// Whether a row that joins others carries the channel as read at its end: the place in the test,
/// and what is an attitude. Covariates are taken at the end as well, of several readings; the rest
/// is averaged.
bool read_at_the_end(std::string_view name);

/// A name that CSV, HDF5 and MATLAB can all hold: a letter, then letters, digits and underscores,
/// at most 63; not "units", "facts" or one that ends in "_unit", which MATLAB files use.
bool valid_channel_name(std::string_view name);

/// Whether any term may use the channel but none has to (temperature, field_n, ...).
bool is_covariate(std::string_view name, RecordingKind kind);

/// A value [internal units] in the unit of its channel, such that reading it back gives the value
/// itself, or the nearest to it that this unit can express (within 1 ulp).
double in_unit(double value, const Unit& unit);

}  // namespace drift
