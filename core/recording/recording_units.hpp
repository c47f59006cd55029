#pragma once

#include <string>
#include <vector>

#include "core/recording/recording.hpp"
#include "core/recording/recording_problems.hpp"
#include "core/recording/recording_raw.hpp"

namespace drift {

/// What the units of a recording depend on.
struct UnitContext {
  RecordingKind kind = RecordingKind::platform;
  SampleKind samples = SampleKind::rates;
  double gravity = 9.80665;  ///< of the site [m/s^2]
};

/// Channels that need a unit and have none are one problem.
void check_units_given(const std::vector<RawColumn>& columns, const UnitContext& context,
                       Problems& problems);

/// The unit that a column is converted with. An unknown or unfit unit of a channel that is
/// needed is a problem; a covariate without a known one is carried as a plain number, with a
/// remark, and under a name that no term takes for its own where its name is one.
/// Accelerations in m/s^2 keep that symbol, the size of the unit being 1/gravity in g.
Unit checked_unit(RawColumn& column, const UnitContext& context, Problems& problems,
                  WeighedTexts& remarks);

/// Adds the column's offset to its converted values.
void add_offset(RawColumn& column, const Unit& unit, Problems& problems);

/// Makes rates of the angles [rad] and velocities [g s] that gyros and accelerometers gained over
/// each sample interval. An interval that differs from the median by more than half of it is one
/// where rows are missing: there the median is taken.
void make_rates(Recording& recording, double gravity);

/// The unit in which gravity has so many, within 1 %; empty if none that is known here.
std::string_view unit_of_one_g(double number);

/// How long the specific force is in every row of a dwell that has all three accelerometers [g].
std::vector<double> specific_forces(const Recording& recording);

/// Says where the accelerometers read what gravity is in another unit: a wrong unit. Of a platform
/// more is known: check_one_g().
void check_gravity(const Recording& recording, Problems& problems);

}  // namespace drift
