#pragma once

#include <cmath>

#include "core/base/rng.hpp"

namespace drift {

/// What is believed of a number before data: fixed, normal (a = mean, b = sigma) or uniform (a..b).
/// In the unit of whoever holds it.
struct Prior {
  enum class Kind { fixed, normal, uniform };
  Kind kind = Kind::fixed;
  double a = 0.0;
  double b = 0.0;

  constexpr double mean() const { return kind == Kind::uniform ? 0.5 * (a + b) : a; }
  double sigma() const {
    switch (kind) {
      case Kind::normal:
        return b;
      case Kind::uniform:
        return std::abs(b - a) / std::sqrt(12.0);
      case Kind::fixed:
        break;
    }
    return 0.0;
  }
  double draw(Stream& stream) const {
    switch (kind) {
      case Kind::normal:
        return a + b * stream.normal();
      case Kind::uniform:
        return a + (b - a) * stream.uniform();
      case Kind::fixed:
        break;
    }
    return a;
  }
  constexpr Prior scaled(double factor) const { return {kind, a * factor, b * factor}; }
  constexpr bool operator==(const Prior&) const = default;
};

constexpr Prior fixed(double value) {
  return {Prior::Kind::fixed, value, 0.0};
}
constexpr Prior normal(double mean, double sigma) {
  return {Prior::Kind::normal, mean, sigma};
}
constexpr Prior uniform(double low, double high) {
  return {Prior::Kind::uniform, low, high};
}

}  // namespace drift
