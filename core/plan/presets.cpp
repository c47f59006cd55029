#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <numbers>
#include <span>

#include "core/plan/test_plan.hpp"

namespace drift {
namespace {

struct NamedPosition {
  const char* name;
  const char* axes;
};

/// Two headings per up-axis; the first six lines are preset six.
constexpr NamedPosition cardinal[] = {
    {"x up, y north", "x=U y=N z=W"}, {"x down, y north", "x=D y=N z=E"},
    {"y up, z north", "x=W y=U z=N"}, {"y down, z north", "x=E y=D z=N"},
    {"z up, x north", "x=N y=W z=U"}, {"z down, x north", "x=N y=E z=D"},
    {"x up, y west", "x=U y=W z=S"},  {"x down, y west", "x=D y=W z=N"},
    {"y up, z west", "x=S y=U z=W"},  {"y down, z west", "x=N y=D z=W"},
    {"z up, x west", "x=W y=S z=U"},  {"z down, x west", "x=W y=N z=D"},
    {"x up, y south", "x=U y=S z=E"}, {"x down, y south", "x=D y=S z=W"},
    {"y up, z south", "x=E y=U z=S"}, {"y down, z south", "x=W y=D z=S"},
    {"z up, x south", "x=S y=E z=U"}, {"z down, x south", "x=S y=W z=D"},
    {"x up, y east", "x=U y=E z=N"},  {"x down, y east", "x=D y=E z=S"},
    {"y up, z east", "x=N y=U z=E"},  {"y down, z east", "x=S y=D z=E"},
    {"z up, x east", "x=E y=N z=U"},  {"z down, x east", "x=E y=S z=D"},
};

/// Positions 1 to 10 of the Apollo guidance computer's IMU performance test (physics.md 3.2).
constexpr NamedPosition apollo[] = {
    {"1", "x=U y=S z=E"},   {"2", "x=D y=W z=N"},    {"3", "x=N y=W z=U"},   {"4", "x=E y=S z=D"},
    {"5", "x=W y=U z=N"},   {"6", "x=S y=D z=E"},    {"7", "x=N y=UW z=UE"}, {"8", "x=E y=UN z=US"},
    {"9", "x=UE y=UW z=S"}, {"10", "x=UN y=US z=E"},
};

/// 12 positions joined by 11 slews of 90 deg about all axes in both senses. The z axis stays in the
/// West-Up plane, so that a three-gimbal chain in a case that heads North never leaves middle = 0.
constexpr NamedPosition slew_sequence[] = {
    {"1", "x=N y=W z=U"}, {"2", "x=N y=U z=E"},  {"3", "x=U y=S z=E"},  {"4", "x=W y=S z=U"},
    {"5", "x=D y=S z=W"}, {"6", "x=S y=U z=W"},  {"7", "x=U y=N z=W"},  {"8", "x=N y=D z=W"},
    {"9", "x=N y=E z=D"}, {"10", "x=W y=N z=D"}, {"11", "x=D y=N z=E"}, {"12", "x=S y=D z=E"},
};

/// Three attitudes with z within 45 deg of vertical, so that the case can turn all the way round.
constexpr NamedPosition spin_attitudes[] = {
    {"z up", "x=N y=W z=U"},
    {"x and z up at 45 deg", "x=UN y=W z=US"},
    {"y and z up at 45 deg", "x=N y=UW z=UE"},
};
constexpr double spin_turns = 3.0;

Position make_position(const NamedPosition& from, const PlanDefaults& defaults, Entry entry) {
  Position p;
  std::string why;
  p.name = from.name;
  p.axes = from.axes;
  p.R_lp = parse_axes(from.axes, why).value();
  p.dwell = defaults.dwell;
  p.sample = defaults.sample;
  p.mode = defaults.mode.value_or(CommandLaw::free);
  p.entry = entry;
  return p;
}

using Positions = std::vector<Position>;

Positions positions_of(std::span<const NamedPosition> table, const PlanDefaults& defaults,
                       Entry entry) {
  Positions all;
  for (const NamedPosition& position : table)
    all.push_back(make_position(position, defaults, defaults.entry.value_or(entry)));
  return all;
}

template <std::size_t count>
Positions first_cardinal(const PlanDefaults& defaults) {
  return positions_of(std::span(cardinal).first(count), defaults, Entry::caged);
}

Positions apollo_test(const PlanDefaults& defaults) {
  return positions_of(apollo, defaults, Entry::caged);
}

Positions slews(const PlanDefaults& defaults) {
  return positions_of(slew_sequence, defaults, Entry::torqued);
}

/// The six of preset six, then the 12 attitudes in which two axes share the vertical at 45 deg.
Positions faces_and_edges(const PlanDefaults& defaults) {
  Positions all = first_cardinal<6>(defaults);
  for (int i = 0; i < 3; ++i)
    for (int signs = 0; signs < 4; ++signs) {
      const bool down_i = signs & 1, down_j = signs & 2;
      std::array<const char*, 3> direction{};
      direction[i] = down_i ? "DS" : "UN";
      direction[(i + 1) % 3] = down_j ? "DN" : "US";
      direction[(i + 2) % 3] = down_i == down_j ? "E" : "W";
      const auto axes = fmt::format("x={} y={} z={}", direction[0], direction[1], direction[2]);
      const auto name = fmt::format("{} {}, {} {}", "xyz"[i], down_i ? "down" : "up",
                                    "xyz"[(i + 1) % 3], down_j ? "down" : "up");
      all.push_back(make_position({name.c_str(), axes.c_str()}, defaults,
                                  defaults.entry.value_or(Entry::caged)));
    }
  return all;
}

/// Each attitude is caged and watched, then the case turns and the attitude is watched again.
Positions case_spins(const PlanDefaults& given) {
  PlanDefaults defaults = given;
  if (!defaults.mode) defaults.mode = CommandLaw::level;
  Positions all;
  for (const auto& attitude : spin_attitudes) {
    Position still = make_position(attitude, defaults, Entry::caged);
    still.case_heading = 0.0;
    Position turned = make_position(attitude, defaults, Entry::torqued);
    turned.name += fmt::format(", after {} turns of the case", spin_turns);
    turned.case_heading = spin_turns * 2.0 * std::numbers::pi;
    all.push_back(still);
    all.push_back(turned);
  }
  return all;
}

/// A name of plan.preset and its positions. A new preset is a row here.
struct Preset {
  std::string_view name;
  Positions (*positions)(const PlanDefaults&);
};
constexpr Preset presets[] = {
    {"six", first_cardinal<6>}, {"twelve", first_cardinal<12>}, {"twentyfour", first_cardinal<24>},
    {"apollo10", apollo_test},  {"eighteen", faces_and_edges},  {"slew12", slews},
    {"casespin", case_spins}};

std::vector<std::string_view> names_of_presets() {
  std::vector<std::string_view> names;
  for (const Preset& preset : presets) names.push_back(preset.name);
  return names;
}

}  // namespace

const std::vector<std::string_view> preset_names = names_of_presets();

std::optional<TestPlan> preset_plan(std::string_view name, const PlanDefaults& defaults) {
  const auto* preset = std::ranges::find(presets, name, &Preset::name);
  if (preset == std::end(presets)) return std::nullopt;
  TestPlan plan;
  plan.preset = name;
  plan.positions = preset->positions(defaults);
  plan.positions.front().entry = Entry::caged;  // nothing to slew from
  return plan;
}

}  // namespace drift
