#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace drift {

/// A number as JSON has it: what is not finite becomes null, and null is not a number.
inline nlohmann::ordered_json json_number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}
inline double number_of(const nlohmann::ordered_json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

/// A number of things, 0 or more. The library would make some number of what is broken, negative or
/// too large, which is undefined behaviour for some.
template <class Whole>
Whole whole_of(const nlohmann::ordered_json& json) {
  constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<Whole>::max());
  const bool negative =
      !json.is_number_unsigned() && json.is_number_integer() && json.get<std::int64_t>() < 0;
  if (!json.is_number_integer() || negative || json.get<std::uint64_t>() > most)
    throw std::runtime_error(json.dump() + " is no number of things");
  return json.get<Whole>();
}

}  // namespace drift
