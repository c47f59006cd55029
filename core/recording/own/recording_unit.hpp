#pragma once

#include <optional>
#include <string_view>

#include "core/base/units.hpp"

namespace drift {

/// Reads a unit as people write it above a column: what parse_unit() knows, and m/s2, m/s², µg, us,
/// °/s, dps, sec, °C, and the size of one count, as "0.1 arcsec". Empty if it is none.
///
/// The symbol is that of the program's own spelling where the size is the same (m/s² -> m/s^2),
/// else as written, so that a file written with it reads back alike.
std::optional<Unit> parse_recording_unit(std::string_view text);

/// Whether a number means the same in both: a temperature in K is not one in degC.
bool same_unit(const Unit& a, const Unit& b);

}  // namespace drift
