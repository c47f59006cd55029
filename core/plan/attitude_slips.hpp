#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/linalg.hpp"
#include "core/base/units.hpp"
#include "core/plan/row_mistake.hpp"

namespace drift {

/// An attitude that three channels show in one row, and the one that it should be.
struct Sight {
  std::size_t row = 0;
  int position = 0;
  double heading = 0.0;  ///< of the case [rad]
  double planned = 0.0;  ///< heading of the case in the plan [rad]
  Mat3 R_lr;             ///< of the plan
  Vec3 seen;
};

/// By what an attitude may miss the plan's before it is another one [rad].
inline constexpr double largest_mismatch = 10.0 * detail::deg;
/// One part in so many of a position is its begin, or its end: rows there may be on the way, or of
/// the position beside it, and those farther in are its own.
inline constexpr std::size_t parts_of_a_position = 4;
/// Fewer positions fit several guesses.
inline constexpr std::size_t fewest_sights = 3;

/// How far the attitude that gimbal angles show is from the plan's [rad].
double gimbal_mismatch(const Sight& sight);

/// The units that the gimbal angles (outer, middle, inner) and the heading of the case are in, as
/// the recording says.
using AngleUnits = std::array<Unit, 4>;

/// Units that an angle may be in: those of study files, and grads, with their size [rad].
std::vector<std::pair<std::string_view, double>> angle_units();

/// The unit in which all three gimbals would show the plan at these sights, of those that logs are
/// written in, as a sentence behind another one: a part of a log in another unit. Empty where none
/// does.
std::string unit_there(const std::vector<Sight>& sights, const AngleUnits& units);

/// Something else than exchanged columns that explains why gimbal angles do not show the attitude
/// of the plan, and what to do, in words: angles in another unit (all, two or one of them), another
/// heading of the case, other zeros of the gimbals. Empty where nothing simple brings every
/// position into place; simpler explanations come first.
std::optional<std::string> slip_behind(const std::vector<Sight>& sights, const AngleUnits& units);

/// A middle gimbal does not come past 90 deg: one that shows more than a turn is in another unit,
/// though whole turns may hide that, or its turns are counted from elsewhere. What to do, in words.
std::optional<RowMistake> middle_beyond_a_turn(const std::vector<Sight>& sights,
                                               const AngleUnits& units);

}  // namespace drift
