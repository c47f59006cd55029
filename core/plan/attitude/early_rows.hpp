#pragma once

#include <optional>

#include "core/plan/row_mistake.hpp"
#include "core/plan/timeline.hpp"
#include "core/recording/recording.hpp"

namespace drift {

/// Columns of gimbals or of accelerometers that stand a row early: in the last row of three caged
/// positions or more, and of every one whose next position reads otherwise by largest_mismatch,
/// they read what the first row of the next does rather than what the row before does, and those of
/// the other kind of instrument nowhere. Where both do, it is the numbers that come late.
std::optional<RowMistake> early_columns(const Recording& recording, const Timeline& timeline);

}  // namespace drift
