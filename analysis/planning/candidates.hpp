#pragma once

#include <vector>

#include "core/plan/test_plan.hpp"

namespace drift::planning {

/// Local directions of the platform axes of the 24 cardinal attitudes and of each of them turned by
/// 45 deg about a platform axis (physics.md 3.3), as text for `axes`: 96 in all. Among them are all
/// headings in steps of 90 deg, of 45 deg where an axis is vertical.
std::vector<std::string> candidate_axes();

/// Positions that may come next: every attitude under both command laws, caged. Dwell and sample
/// interval are those of the last position of the plan.
std::vector<Position> caged_candidates(const TestPlan& plan);

/// The same slewed to by gyro commands, each with the case left where the gimbals allow it, and
/// with the case turned half round from `heading` [rad] on the way. Empty unless a position of the
/// plan is entered so.
std::vector<Position> torqued_candidates(const TestPlan& plan, double heading);

/// A position as a table [[plan.position]] of a study file, every value written out.
std::string position_toml(const Position& position);

}  // namespace drift::planning
