#include "core/plan/test_plan.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <span>

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

void add(TestPlan& plan, std::span<const NamedPosition> table, const PlanDefaults& defaults,
         Entry entry) {
  for (const NamedPosition& position : table)
    plan.positions.push_back(make_position(position, defaults, defaults.entry.value_or(entry)));
}

/// The 12 attitudes in which two axes share the vertical at 45 deg.
void add_edges(TestPlan& plan, const PlanDefaults& defaults) {
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
      plan.positions.push_back(make_position({name.c_str(), axes.c_str()}, defaults,
                                             defaults.entry.value_or(Entry::caged)));
    }
}

/// Each attitude is caged and watched, then the case turns and the attitude is watched again.
void add_case_spins(TestPlan& plan, PlanDefaults defaults) {
  if (!defaults.mode) defaults.mode = CommandLaw::level;
  for (const auto& attitude : spin_attitudes) {
    Position still = make_position(attitude, defaults, Entry::caged);
    still.case_heading = 0.0;
    Position turned = make_position(attitude, defaults, Entry::torqued);
    turned.name += fmt::format(", after {} turns of the case", spin_turns);
    turned.case_heading = spin_turns * 2.0 * std::numbers::pi;
    plan.positions.push_back(still);
    plan.positions.push_back(turned);
  }
}

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

}  // namespace

const std::vector<std::string_view> preset_names = {"six",      "twelve", "twentyfour", "apollo10",
                                                    "eighteen", "slew12", "casespin"};

std::optional<TestPlan> preset_plan(std::string_view name, const PlanDefaults& defaults) {
  TestPlan plan;
  plan.preset = name;
  if (name == "six") {
    add(plan, std::span(cardinal).first(6), defaults, Entry::caged);
  } else if (name == "twelve") {
    add(plan, std::span(cardinal).first(12), defaults, Entry::caged);
  } else if (name == "twentyfour") {
    add(plan, cardinal, defaults, Entry::caged);
  } else if (name == "apollo10") {
    add(plan, apollo, defaults, Entry::caged);
  } else if (name == "eighteen") {
    add(plan, std::span(cardinal).first(6), defaults, Entry::caged);
    add_edges(plan, defaults);
  } else if (name == "slew12") {
    add(plan, slew_sequence, defaults, Entry::torqued);
  } else if (name == "casespin") {
    add_case_spins(plan, defaults);
  } else {
    return std::nullopt;
  }
  plan.positions.front().entry = Entry::caged;  // nothing to slew from
  return plan;
}

std::optional<Mat3> parse_axes(std::string_view text, std::string& why) {
  Mat3 R_lp = Mat3::Zero();
  std::array<bool, 3> given{};
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
    if (given[axis]) {
      why = fmt::format("axis {} is given twice", word[0]);
      return std::nullopt;
    }
    given[axis] = true;
    R_lp.col(axis) = *direction;
  }
  if (!(given[0] && given[1] && given[2])) {
    why = "all three axes x, y and z must be given";
    return std::nullopt;
  }
  if ((R_lp.transpose() * R_lp - Mat3::Identity()).cwiseAbs().maxCoeff() > 1e-9) {
    why = "the axes are not perpendicular";
    return std::nullopt;
  }
  if (R_lp.determinant() < 0.0) {
    why = "the axes are left-handed";
    return std::nullopt;
  }
  return R_lp;
}

}  // namespace drift
