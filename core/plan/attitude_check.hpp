#pragma once

#include <vector>

#include "core/plan/row_mistake.hpp"
#include "core/plan/test_plan.hpp"
#include "core/plan/timeline.hpp"
#include "core/recording/recording.hpp"

namespace drift {

/// Where the instruments of a recording do not show the attitude that the plan has, at the first
/// row of each caged position: 10 deg off is another plan. One mistake for each kind of instrument;
/// where exchanging or reversing its columns, another unit of some angles, or another heading of
/// the case brings all positions into place, that is said. Where both kinds agree with each other
/// and not with the plan, it is one mistake. Where the platform is slewed from position to position
/// it should turn as commanded (slew_mistake()); then accelerometers should show Up where the
/// gimbals have it, whatever the drift. Columns that show the next position in last rows
/// (early_columns()) are a mistake as well.
std::vector<RowMistake> attitude_mistakes(const Recording& recording, const TestPlan& plan,
                                          const Timeline& timeline);

}  // namespace drift
