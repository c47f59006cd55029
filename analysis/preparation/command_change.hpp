#pragma once

#include <string>

#include "core/physics/earth.hpp"
#include "core/recording/recording.hpp"
#include "core/recording/rows/row_spacing.hpp"

namespace drift::preparation {

/// When the command changed between two rows; or why that is not known.
struct CommandChange {
  double time = 0.0;  ///< [s]
  std::string why_not;
  /// By what the platform turned otherwise than it does if no row is missing [rad]; NaN: unknown.
  double as_recorded = nan_value;
};

/// Between a row and the one before it, rows are missing and the command changed from the one to
/// the other. The gimbal angles on both sides tell how far each of them turned the platform. Of the
/// times at which rows would have stood, counted from either side, it is the one that fits best, to
/// three tenths of a row.
CommandChange command_change(const Recording& recording, const Site& site, std::size_t row,
                             const RowSpacing& spacing);

}  // namespace drift::preparation
