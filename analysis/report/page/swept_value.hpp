#pragma once

#include <optional>
#include <string>

#include "core/base/units.hpp"

namespace drift::report {

/// The number a value of a sweep stands for: of "20 arcsec" 20 arcsec, of 0.5 that, of a
/// distribution or table its last number. In SI, with the unit it was written in; empty if it holds
/// none.
struct SweptNumber {
  double si = 0.0;
  Unit unit;
};
std::optional<SweptNumber> swept_number(const std::string& value);

/// Of a table, the name of its last member: of `{ eta = "1 arcsec", xi = "2 arcsec" }` xi. Else
/// empty.
std::string last_member(const std::string& value);

/// A value as a label: of a table its members with the last number of each, "eta 5 arcsec, xi 5
/// arcsec", and words without quotes, "preset six, dwell 20 min"; one word alone, "six", of a table
/// of nothing else; anything else as it is.
std::string short_value(const std::string& value);

}  // namespace drift::report
