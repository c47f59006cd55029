#include "core/plan/test_plan.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

namespace drift {
namespace {

std::optional<Vec3> parse_direction(std::string_view letters) {
  if (letters.empty() || letters.size() > 3) return std::nullopt;
  Vec3 v = Vec3::Zero();
  for (const char c : letters) {
    switch (c) {
      case 'N':
        v += Vec3::UnitX();
        break;
      case 'S':
        v -= Vec3::UnitX();
        break;
      case 'W':
        v += Vec3::UnitY();
        break;
      case 'E':
        v -= Vec3::UnitY();
        break;
      case 'U':
        v += Vec3::UnitZ();
        break;
      case 'D':
        v -= Vec3::UnitZ();
        break;
      default:
        return std::nullopt;
    }
  }
  const double n = std::sqrt(static_cast<double>(letters.size()));
  if (std::abs(v.norm() - n) > 1e-9) return std::nullopt;  // "NS", "NN"
  return v / n;
}

/// The letters of a direction, of the one that points away from it.
std::string opposite(std::string_view direction) {
  constexpr std::string_view letters = "NSEWUD";
  std::string other;
  for (const char c : direction) other += letters[letters.find(c) ^ 1u];
  return other;
}

}  // namespace

std::optional<Mat3> parse_axes(std::string_view text, std::string& why) {
  Mat3 R_lp = Mat3::Zero();
  std::array<std::string_view, 3> given{};
  std::size_t at = 0;
  while (true) {
    at = text.find_first_not_of(' ', at);
    if (at == std::string_view::npos) break;
    const auto end = std::min(text.find(' ', at), text.size());
    const std::string_view word = text.substr(at, end - at);
    at = end;
    if (word.size() < 3 || word[0] < 'x' || word[0] > 'z' || word[1] != '=') {
      why = fmt::format("'{}' is not of the form x=N", word);
      return std::nullopt;
    }
    const int axis = word[0] - 'x';
    const auto direction = parse_direction(word.substr(2));
    if (!direction) {
      why = fmt::format(
          "'{}' is no direction (N S E W U D, or letters joined such as UN for the "
          "direction half way between Up and North)",
          word.substr(2));
      return std::nullopt;
    }
    if (!given[axis].empty()) {
      why = fmt::format("axis {} is given twice", word[0]);
      return std::nullopt;
    }
    given[axis] = word.substr(2);
    R_lp.col(axis) = *direction;
  }
  if (given[0].empty() || given[1].empty() || given[2].empty()) {
    why = "all three axes x, y and z must be given";
    return std::nullopt;
  }
  if ((R_lp.transpose() * R_lp - Mat3::Identity()).cwiseAbs().maxCoeff() > 1e-9) {
    why = "the axes are not perpendicular";
    return std::nullopt;
  }
  if (R_lp.determinant() < 0.0) {
    why = fmt::format("the axes are left-handed, with x={} and y={} z points {}", given[0],
                      given[1], opposite(given[2]));
    return std::nullopt;
  }
  return R_lp;
}

std::string attitude_text(const Position& position) {
  std::string text = position.axes;
  for (const AxisTurn& turn : position.turns) text += ", " + turn.text;
  return text;
}

}  // namespace drift
