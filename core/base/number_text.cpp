#include "core/base/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drift {
namespace {

/// How many decimals make a sigma one or two digits long; negative for large ones.
int decimals_of(double sigma) {
  const double decade = std::floor(std::log10(sigma)), lead = sigma / std::pow(10.0, decade);
  return (lead < 3.55 ? 1 : 0) - static_cast<int>(decade);
}

/// Decimals of a number in six significant digits.
int decimals_in(const std::string& text) {
  const auto point = text.find('.');
  return point == std::string::npos ? 0 : static_cast<int>(text.size() - point - 1);
}

}  // namespace

std::string number_text(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  constexpr double longest = 1e6;  // below, "1000" rather than "1e+03"
  if (std::abs(value) >= std::pow(10.0, digits) - 0.5 && std::abs(value) < longest)
    return fmt::format("{:.0f}", value);
  return fmt::format("{:.{}g}", value == 0.0 ? 0.0 : value, digits);
}

std::string decimal_text(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  if (std::abs(value) >= 1e9) return fmt::format("{:.3g}", value);
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  const bool zero = text.find_first_of("123456789") == std::string::npos;
  return zero && text[0] == '-' ? text.substr(1) : text;
}

std::string with_sigma(double value, double sigma) {
  if (!std::isfinite(value)) return "-";
  if (!std::isfinite(sigma) || sigma <= 0.0) return number_text(value, 4);
  const int decimals = decimals_of(sigma);
  if (decimals > 9 || std::abs(value) >= 1e9)
    return fmt::format("{}±{}", number_text(value, 4), number_text(sigma, 2));
  const int shown = std::max(decimals, 0);
  return decimal_text(value, shown) + "±" + decimal_text(sigma, shown);
}

std::string to_match(double value, double sigma) {
  if (!std::isfinite(sigma) || sigma <= 0.0 || decimals_of(sigma) > 9) return number_text(value, 4);
  return decimal_text(value, std::max(decimals_of(sigma), 0));
}

std::string as_given(double value, double sigma) {
  const std::string v = number_text(value, 6), s = number_text(sigma, 6);
  if ((v + s).find('e') != std::string::npos) return v + "±" + s;
  const int decimals = std::max(decimals_in(v), decimals_in(s));
  return decimal_text(value, decimals) + "±" + decimal_text(sigma, decimals);
}

std::string p_text(double p) {
  if (!std::isfinite(p)) return "-";
  if (p < 1e-300) return "below 1e-300";
  if (p >= 1e-3) return number_text(p, 2);
  std::string text = fmt::format("{:.0e}", p);
  if (const auto zero = text.find("e-0"); zero != std::string::npos) text.erase(zero + 2, 1);
  return text;
}

}  // namespace drift
