#include "analysis/diagnosis/advice.hpp"

#include <fmt/format.h>

#include <cmath>

namespace drift::diagnosis {
namespace {

using config::Node;

Node text_node(std::string text) {
  Node node;
  node.kind = Node::Kind::string;
  node.text = std::move(text);
  return node;
}

/// In whole minutes or seconds where it is whole, so that people can read it.
std::string time_text(double seconds) {
  const double minutes = seconds / 60.0;
  return minutes == std::round(minutes) ? fmt::format("{:.0f} min", minutes)
                                        : fmt::format("{} s", seconds);
}

}  // namespace

Node position_node(const Position& p) {
  Node node;
  const auto add = [&](const char* key, std::string text) {
    node.members.push_back({key, {}, text_node(std::move(text))});
  };
  add("name", p.name);
  add("axes", p.axes);
  add("dwell", time_text(p.dwell));
  add("sample", fmt::format("{} s", p.sample));
  add("mode", p.mode == CommandLaw::level ? "level" : "free");
  add("entry", p.entry == Entry::torqued ? "torqued" : "caged");
  if (p.case_heading)
    add("case_heading", fmt::format("{:.10g} deg", *p.case_heading / unit::deg.to_si));
  return node;
}

std::string positions_toml(const std::vector<Position>& positions) {
  std::string out;
  for (const Position& p : positions) {
    out += out.empty() ? "[[plan.position]]\n" : "\n[[plan.position]]\n";
    for (const auto& member : position_node(p).members)
      out += fmt::format("{} = {}\n", member.key, to_toml(member.value));
  }
  return out;
}

}  // namespace drift::diagnosis
