#pragma once

#include <optional>
#include <string>

#include "core/base/units.hpp"

namespace drift::report {

/// The number a value of a sweep stands for: of "20 arcsec" 20 arcsec, of 0.5 that, of a table that
/// of its last member, of a normal distribution its sigma, of a uniform one its upper end. In SI,
/// with the unit it was written in; empty if it holds none.
struct SweptNumber {
  double si = 0.0;
  Unit unit;
  std::string what;  ///< "sigma", "half width" or "upper end" of a distribution; else empty
  std::string kind;  ///< values whose numbers mean the same have the same, with the same mean, say
};
std::optional<SweptNumber> swept_number(const std::string& value);

/// Of a table, the name of its last member: of `{ eta = "1 arcsec", xi = "2 arcsec" }` xi. Else, as
/// of a distribution, empty.
std::string last_member(const std::string& value);

/// A value as a label, other values having other ones: of a table its members, "eta 5 arcsec, xi 5
/// arcsec", and words without quotes, "preset six, dwell 20 min"; of a normal distribution "-40 +-
/// 5 deg/h", of a uniform one "-90 to 5 deg/h"; one word alone, "six", of a table of nothing else;
/// anything else as it is.
std::string short_value(const std::string& value);

}  // namespace drift::report
