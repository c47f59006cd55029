#pragma once

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace drift {

/// A number as JSON has it: what is not finite becomes null, and null is not a number.
inline nlohmann::ordered_json json_number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}
inline double number_of(const nlohmann::ordered_json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

}  // namespace drift
