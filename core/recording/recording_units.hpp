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
                  std::vector<std::string>& remarks);

/// Adds the column's offset to its converted values.
void add_offset(RawColumn& column, const Unit& unit, Problems& problems);

/// Makes rates of the angles [rad] and velocities [g s] that gyros and accelerometers gained over
/// each sample interval. An interval that differs from the median by more than half of it is one
/// where rows are missing: there the median is taken.
void make_rates(Recording& recording, double gravity);

/// Says where the accelerometers read g times a power of ten or times 9.8: a wrong unit.
void check_gravity(const Recording& recording, Problems& problems);

}  // namespace drift
