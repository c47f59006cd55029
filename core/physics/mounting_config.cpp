#include "core/physics/mounting_config.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>

namespace drift {
namespace {

constexpr std::string_view axis_letters = "xyz";

std::optional<std::array<SignedAxis, 3>> parse_triad(std::string_view text) {
  std::array<SignedAxis, 3> triad{};
  std::size_t count = 0;
  double sign = 1.0;
  bool signed_letter = false;
  for (const char c : text) {
    if (const auto index = axis_letters.find(c); index != std::string_view::npos) {
      if (count == 3) return std::nullopt;
      triad[count++] = {static_cast<int>(index), sign};
      sign = 1.0;
      signed_letter = false;
    } else if ((c == '-' || c == '+') && !signed_letter) {
      sign = c == '-' ? -1.0 : 1.0;
      signed_letter = true;
    } else if (c != ' ' || signed_letter) {
      return std::nullopt;
    }
  }
  if (count != 3 || signed_letter) return std::nullopt;
  return triad;
}

std::string triad_text(int axis, const Triads& triads) {
  const auto letter = [](const SignedAxis& a) {
    return fmt::format("{}{}", a.sign < 0.0 ? "-" : "", axis_letters[a.index]);
  };
  return fmt::format("{} {} {}", axis_letters[axis], letter(triads.second[axis]),
                     letter(triads.third[axis]));
}

Vec3 direction(const SignedAxis& a) {
  return a.sign * Vec3::Unit(a.index);
}

/// Why a triad is no mounting of instrument `axis`; empty if it is one.
std::string objection(const std::optional<std::array<SignedAxis, 3>>& triad, int axis) {
  if (!triad) return "is not three signed axes";
  const auto& [input, second, third] = *triad;
  if (input.index != axis || input.sign < 0.0)
    return fmt::format("does not begin with the instrument's own input axis {}",
                       axis_letters[axis]);
  if ((direction(input).cross(direction(second)) - direction(third)).norm() > 0.5)
    return "is not right-handed";
  return {};
}

void read_triads(config::Section& section, std::string_view instrument, Triads& triads) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::string key = fmt::format("{}_{}", instrument, axis_letters[axis]);
    std::string text = triad_text(axis, triads);
    const std::string usual = text;
    const config::Node* node = nullptr;
    if (section.read(config::Option{.key = key, .doc = "triad"}, text)) node = section.take(key);
    if (node == nullptr) continue;
    const auto triad = parse_triad(text);
    if (const auto why = objection(triad, axis); !why.empty()) {
      section.report().error(
          node->at,
          fmt::format("'{}' = \"{}\" {} (expected a right-handed triad such as \"{}\"). Name "
                      "input and two further axes, each with an optional minus sign",
                      section.full(key), text, why, usual));
      continue;
    }
    triads.second[axis] = (*triad)[1];
    triads.third[axis] = (*triad)[2];
  }
}

}  // namespace

Mounting read_mounting(config::Section section) {
  Mounting mounting;
  read_triads(section, "gyro", mounting.gyro);
  read_triads(section, "accelerometer", mounting.accelerometer);
  section.finish();
  return mounting;
}

}  // namespace drift
