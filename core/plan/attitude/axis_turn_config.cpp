#include "core/plan/attitude/axis_turn_config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "core/config/nearest.hpp"

namespace drift {
namespace {

using config::Option;
using config::Section;

constexpr std::string_view turn_key = "turn";
constexpr const char* turn_expected =
    "a turn about an axis of the platform, such as \"10 deg about y\", or a list of turns, done "
    "one "
    "after the other";
constexpr Option angle_option{turn_key, unit::deg, -360.0, 360.0, "about an axis of the platform"};
constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};

/// A turn in words, with one blank between two: "10 deg", "y".
struct Words {
  std::string angle, axis;
  bool about = false;  ///< whether there is an axis, though it may have no name

  explicit Words(std::string_view text) {
    constexpr std::string_view blanks = " \t\r\n";
    while (true) {
      const auto first = text.find_first_not_of(blanks);
      if (first == std::string_view::npos) return;
      text.remove_prefix(first);
      const std::string_view word = text.substr(0, text.find_first_of(blanks));
      text.remove_prefix(word.size());
      if (word == "about" && !about) {
        about = true;
        continue;
      }
      std::string& part = about ? axis : angle;
      part += part.empty() ? "" : " ";
      part += word;
    }
  }
};

std::optional<AxisTurn> read_turn(Section& section, const config::Node& node) {
  const std::string full = section.full(turn_key);
  if (!node.is(config::Node::Kind::string) || node.text.size() > config::longest_text) {
    section.report().error(
        node.at, fmt::format("'{}' is {} (expected {}). Write {} = \"10 deg about y\"", full,
                             config::describe(node), turn_expected, turn_key));
    return std::nullopt;
  }
  const Words words(node.text);
  if (words.axis.empty()) {
    section.report().error(
        node.at, fmt::format("'{}' = {} names no axis (expected an angle and an axis of the "
                             "platform, such as \"10 deg about y\"). Add about x, about y or about "
                             "z",
                             full, to_toml(node)));
    return std::nullopt;
  }
  const auto axis = std::ranges::find(axes, words.axis);
  if (axis == axes.end())
    section.report().error(
        node.at, fmt::format("'{}' = {} turns about '{}' (expected x, y or z, an axis of the "
                             "platform). {}",
                             full, to_toml(node), words.axis,
                             config::suggestion(words.axis, axes, "Name x, y or z")));
  config::Node angle = node;
  angle.text = words.angle;
  const auto q = config::read_quantity(section.report(), angle, full, angle_option);
  if (!q || axis == axes.end()) return std::nullopt;
  return AxisTurn{fmt::format("{} about {}", words.angle, words.axis),
                  static_cast<int>(axis - axes.begin()), q->si()};
}

}  // namespace

std::vector<AxisTurn> read_turns(Section& section) {
  std::vector<AxisTurn> turns;
  const config::Node* node = section.take(turn_key, Section::Kind::text_or_list, turn_expected);
  if (node == nullptr) return turns;
  const bool list = node->is(config::Node::Kind::array) && !node->items.empty();
  bool right = true;
  for (const config::Node& one : list ? node->items : std::vector<config::Node>{*node}) {
    auto turn = read_turn(section, one);
    right = right && turn;
    if (turn) turns.push_back(std::move(*turn));
  }
  if (right)
    section.report().given(section.full(turn_key), list ? to_toml(*node) : turns.front().text,
                           node->at);
  return turns;
}

}  // namespace drift
