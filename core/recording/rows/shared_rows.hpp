#pragma once

#include <optional>

#include "core/recording/recording.hpp"

namespace drift {

/// Rows of one recording whose readings are those of rows of another.
struct SharedRows {
  std::size_t first = 0, second = 0;  ///< where they begin in the one and in the other
  std::size_t count = 0;              ///< rows
};

/// The longest stretch of rows that stands in both recordings, by all gyros and accelerometers that
/// both have, or by all gimbal angles: one log cut twice, a copy that lacks a row. Empty: none.
///
/// Readings are the same that agree to nine digits, seven or six: another unit or fewer digits may
/// round them off. The course of two tests of one unit may be the same, so that only noise counts:
/// of every reversal of third differences at rest, larger than rounding makes them, the chance
/// erf(e / (2 sigma)) that two readings with the noise sigma of the stretch agree to e, and all of
/// them have to be less likely than chance_of_repeated_rows anywhere in both. Noise below a
/// millionth of the largest reading is seen in copies with more digits alone, noise that the steps
/// of the readout hide in none. n log n in the rows.
std::optional<SharedRows> shared_rows(const Recording& a, const Recording& b);

}  // namespace drift
