#include "analysis/planning/position_toml.hpp"

#include <fmt/format.h>

#include <cmath>

namespace drift::planning {
namespace {

/// In whole minutes where it is whole, so that people can read it.
std::string time_text(double seconds) {
  const double minutes = seconds / 60.0;
  return minutes == std::round(minutes) ? fmt::format("{:.0f} min", minutes)
                                        : fmt::format("{} s", seconds);
}

}  // namespace

config::Node position_node(const Position& p) {
  config::Node node;
  const auto add = [&](const char* key, std::string text) {
    node.members.push_back({key, {}, config::text_node(std::move(text))});
  };
  add("name", p.name);
  add("axes", p.axes);
  if (p.turns.size() == 1) add("turn", p.turns.front().text);
  if (p.turns.size() > 1) {
    config::Node list = config::list_node({});
    for (const AxisTurn& turn : p.turns) list.items.push_back(config::text_node(turn.text));
    node.members.push_back({"turn", {}, std::move(list)});
  }
  add("dwell", time_text(p.dwell));
  add("sample", fmt::format("{} s", p.sample));
  add("mode", std::string(key_of(p.mode)));
  add("entry", std::string(key_of(p.entry)));
  if (p.case_heading)
    add("case_heading", fmt::format("{:.12g} deg", *p.case_heading / unit::deg.to_si));
  return node;
}

std::string positions_toml(std::span<const Position> positions) {
  std::string out;
  for (const Position& p : positions) {
    out += out.empty() ? "[[plan.position]]\n" : "\n[[plan.position]]\n";
    for (const auto& member : position_node(p).members)
      out += fmt::format("{} = {}\n", member.key, to_toml(member.value));
  }
  return out;
}

}  // namespace drift::planning
