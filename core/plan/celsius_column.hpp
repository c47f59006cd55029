#pragma once

#include <optional>
#include <vector>

#include "core/plan/row_mistake.hpp"
#include "core/recording/recording.hpp"

namespace drift {

/// Turns the values of a column [internal units] as equations of own terms have them: temperatures
/// in degC, whatever the file has them in; of anything else nothing changes. A mistake where a
/// column in K or degF then holds what is no temperature of a test, as a difference in K would.
std::optional<RowMistake> take_celsius(std::vector<double>& values, const Channel& column);

}  // namespace drift
