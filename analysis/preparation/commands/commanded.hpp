#pragma once

#include <optional>
#include <vector>

#include "analysis/preparation/dwell_turn.hpp"
#include "analysis/preparation/input_thresholds.hpp"
#include "core/base/units.hpp"
#include "core/plan/mixup.hpp"
#include "mc/study/study.hpp"

namespace drift::preparation {

/// By how much a command may be another than the plan's and still be of its law [rad/s].
inline constexpr double command_room = PlanLimits::command_deg_per_h * unit::deg_per_h.to_si;

/// What is commanded in a dwell [rad/s], platform axes, and how the platform turns in it.
struct Commanded {
  int position = 0;  ///< from 1
  CommandLaw law = CommandLaw::free;
  Mat3 R_lp;
  Vec3 recorded, planned, by_other_law;
  std::optional<Turn> turn;

  double off() const { return (recorded - planned).norm(); }
};

std::vector<Commanded> commanded_in(const mc::Study& study, const Timeline& timeline,
                                    const Measurements& measured, const std::vector<Dwell>& dwells);

/// Part of the turn, which the recorded commands of level dwells call for and the plan's do not,
/// that the platform makes: 1 if it obeys them, 0 if it stands. NaN where nothing shows that.
double part_obeyed(const std::vector<Commanded>& all);

/// How fast the platform turns against the local axes in level dwells, as far as that is seen, rms
/// [rad/s]; NaN where nothing shows it.
double rms_turn(const std::vector<Commanded>& all);

/// Whether that is far less than under no command (PlanLimits::other_law of the Earth rate, as far
/// as that would be seen). Not where nothing shows it.
bool stands_level(const std::vector<Commanded>& all, const Site& site);

/// The one exchange and reversal of the columns that makes every command the plan's; none where
/// all of them are.
std::optional<Mixup> exchanged_commands(const std::vector<Commanded>& all);

/// Sine of the one latitude whose Earth rate the commands of all level dwells are, another than the
/// site's; none where they are of several, or of none.
std::optional<double> sine_of_another_latitude(const std::vector<Commanded>& all, const Site& site);

/// The constant factor by which a column's commands are the plan's in all level dwells, what is
/// left being PlanLimits::factor_left of what the factor makes at most. None where there is no such
/// factor, or three dwells do not show it.
std::optional<double> factor_of_commands(const std::vector<Commanded>& all, int column);

}  // namespace drift::preparation
