#include "analysis/planning/candidates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace drift::planning {
namespace {

/// "UN" for the direction half way between Up and North, platform axis in local axes.
std::string letters(const Vec3& direction_l) {
  std::string text;
  for (const int axis : {2, 0, 1})
    if (std::abs(direction_l[axis]) > 0.1) text += (direction_l[axis] > 0.0 ? "NWU" : "SED")[axis];
  return text;
}

std::string axes_of(const Mat3& R_lp) {
  return fmt::format("x={} y={} z={}", letters(R_lp.col(0)), letters(R_lp.col(1)),
                     letters(R_lp.col(2)));
}

Position candidate(const TestPlan& plan, const std::string& axes, CommandLaw mode, Entry entry) {
  Position p;
  std::string why;
  p.axes = axes;
  p.R_lp = parse_axes(axes, why).value();
  p.dwell = plan.positions.back().dwell;
  p.sample = plan.positions.back().sample;
  p.mode = mode;
  p.entry = entry;
  return p;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
    else
      out += c;
  }
  return out + '"';
}

}  // namespace

std::vector<std::string> candidate_axes() {
  std::vector<std::string> all;
  const TestPlan cube = preset_plan("twentyfour", {}).value();
  for (const Position& p : cube.positions) all.push_back(p.axes);
  for (int axis = 0; axis < 3; ++axis)
    for (const Position& p : cube.positions)
      all.push_back(axes_of(p.R_lp * rotation<double>(0.25 * std::numbers::pi * Vec3::Unit(axis))));
  return all;
}

std::vector<Position> caged_candidates(const TestPlan& plan) {
  std::vector<Position> all;
  for (const std::string& axes : candidate_axes())
    for (const CommandLaw law : {CommandLaw::free, CommandLaw::level})
      all.push_back(candidate(plan, axes, law, Entry::caged));
  return all;
}

std::vector<Position> torqued_candidates(const TestPlan& plan, double heading) {
  std::vector<Position> all;
  const auto torqued = [](const Position& p) { return p.entry == Entry::torqued; };
  if (std::ranges::none_of(plan.positions, torqued)) return all;
  // A heading that is asked for is written to the study file: whole degrees survive that unchanged.
  const double turned = (std::round(heading / detail::deg) + 180.0) * detail::deg;
  for (const std::string& axes : candidate_axes())
    for (const CommandLaw law : {CommandLaw::free, CommandLaw::level}) {
      Position p = candidate(plan, axes, law, Entry::torqued);
      all.push_back(p);
      p.case_heading = turned;
      all.push_back(p);
    }
  return all;
}

std::string position_toml(const Position& p) {
  std::string text = fmt::format(
      "[[plan.position]]\nname   = {}\naxes   = {}\ndwell  = \"{:.12g} s\"\nsample = \"{:.12g} "
      "s\"\n"
      "mode   = \"{}\"\nentry  = \"{}\"\n",
      quoted(p.name), quoted(p.axes), p.dwell, p.sample,
      p.mode == CommandLaw::free ? "free" : "level", p.entry == Entry::caged ? "caged" : "torqued");
  if (p.case_heading)
    text += fmt::format("case_heading = \"{:.12g} deg\"\n", *p.case_heading / detail::deg);
  return text;
}

}  // namespace drift::planning
