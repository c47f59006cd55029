#include "analysis/report/page/zoom.hpp"

#include <zoom_script.hpp>  // made by the build

#include "core/base/sha256.hpp"

namespace drift::report {
namespace {

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned long three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = 256 * three + (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k <= bytes.size() ? digits[(three >> (18 - 6 * k)) & 63] : '=';
  }
  return out;
}

}  // namespace

std::string_view zoom_script() {
  return detail::zoom_script;
}

std::string_view zoom_style() {
  return detail::zoom_style;
}

std::string policy_of(std::string_view script) {
  return "sha256-" + base64(sha256(script));
}

}  // namespace drift::report
