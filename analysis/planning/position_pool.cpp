#include "analysis/planning/position_pool.hpp"

#include <fmt/format.h>

#include <array>
#include <string>

#include "core/base/check.hpp"
#include "core/plan/timeline.hpp"

namespace drift::planning {
namespace {

constexpr double longer = 3.0;  // long dwells over usual ones

/// Letters of a local direction and its opposite.
struct Direction {
  int axis;  ///< 0 North, 1 West, 2 Up
  int sign;
  char letter() const { return sign > 0 ? "NWU"[axis] : "SED"[axis]; }
  Direction reversed() const { return {axis, -sign}; }
};

std::string axes_text(const std::array<std::string, 3>& d) {
  return fmt::format("x={} y={} z={}", d[0], d[1], d[2]);
}

/// Every "x=.. y=.. z=.." whose directions are along the local axes; left-handed ones are dropped.
std::vector<std::array<Direction, 3>> cube() {
  std::vector<std::array<Direction, 3>> all;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      for (int signs = 0; signs < 8; ++signs) {
        if (x == y) continue;
        const std::array<Direction, 3> d{
            {{x, signs & 1 ? -1 : 1}, {y, signs & 2 ? -1 : 1}, {3 - x - y, signs & 4 ? -1 : 1}}};
        std::string why;
        if (parse_axes(axes_text({std::string(1, d[0].letter()), std::string(1, d[1].letter()),
                                  std::string(1, d[2].letter())}),
                       why))
          all.push_back(d);
      }
  return all;
}

std::vector<std::string> orientations(bool turned) {
  std::vector<std::string> all;
  for (const auto& d : cube()) {
    const auto letter = [&](int k) {
      return std::string(1, d[static_cast<std::size_t>(k)].letter());
    };
    if (!turned) {
      all.push_back(axes_text({letter(0), letter(1), letter(2)}));
      continue;
    }
    for (int still = 0; still < 3; ++still) {
      const auto a = static_cast<std::size_t>((still + 1) % 3),
                 b = static_cast<std::size_t>((still + 2) % 3);
      std::array<std::string, 3> names;
      names[static_cast<std::size_t>(still)] = letter(still);
      names[a] = {d[a].letter(), d[b].letter()};
      names[b] = {d[b].letter(), d[a].reversed().letter()};
      all.push_back(axes_text(names));
    }
  }
  return all;
}

bool possible(const Addition& addition, const Site& site) {
  TestPlan plan;
  plan.positions = addition;
  try {
    lay_out(plan, site);
    return true;
  } catch (const InputError&) {
    return false;  // no heading keeps the middle gimbal small
  }
}

}  // namespace

std::vector<Addition> position_pool(double usual_dwell, double sample, const Site& site) {
  std::vector<Addition> pool;
  std::string why;
  const auto position = [&](const std::string& axes, CommandLaw mode, Entry entry,
                            std::optional<double> heading, double dwell) {
    Position p;
    p.axes = axes;
    p.R_lp = parse_axes(axes, why).value_or(Mat3::Identity());
    p.dwell = dwell;
    p.sample = sample;
    p.mode = mode;
    p.entry = entry;
    p.case_heading = heading;
    p.name = fmt::format(
        "{}, {}{}{}{}", axes, mode == CommandLaw::level ? "level" : "free",
        entry == Entry::torqued ? ", slewed" : "",
        heading ? fmt::format(", case at {:.0f} deg", *heading / unit::deg.to_si) : "",
        dwell == usual_dwell ? "" : fmt::format(", for {:.3g} min", dwell / unit::minute.to_si));
    return p;
  };
  const auto add = [&](Addition addition) {
    if (possible(addition, site)) pool.push_back(std::move(addition));
  };
  for (const CommandLaw mode : {CommandLaw::free, CommandLaw::level}) {
    for (const bool turned : {false, true})
      for (const std::string& axes : orientations(turned)) {
        if (!parse_axes(axes, why)) continue;
        for (const double heading : {0.0, 90.0 * unit::deg.to_si})
          add({position(axes, mode, Entry::caged, heading, usual_dwell)});
        if (!turned) add({position(axes, mode, Entry::caged, 0.0, longer * usual_dwell)});
      }
    for (const std::string& axes : orientations(false))
      if (axes != "x=N y=W z=U")
        add({position("x=N y=W z=U", mode, Entry::caged, {}, usual_dwell),
             position(axes, mode, Entry::torqued, {}, usual_dwell)});
  }
  return pool;
}

}  // namespace drift::planning
