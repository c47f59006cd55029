#include "analysis/planning/attitudes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/plan/test_plan.hpp"

namespace drift::planning {
namespace {

/// "UN" for the direction half way between Up and North, platform axis in local axes.
std::string letters(const Vec3& direction_l) {
  std::string text;
  for (const int axis : {2, 0, 1})
    if (std::abs(direction_l[axis]) > 0.1) text += (direction_l[axis] > 0.0 ? "NWU" : "SED")[axis];
  return text;
}

}  // namespace

std::optional<Attitude> attitude_of(const Mat3& R_lp) {
  std::string why, axes = fmt::format("x={} y={} z={}", letters(R_lp.col(0)), letters(R_lp.col(1)),
                                      letters(R_lp.col(2)));
  const auto exact = parse_axes(axes, why);
  if (!exact || (*exact - R_lp).cwiseAbs().maxCoeff() > 1e-6) return std::nullopt;
  return Attitude{std::move(axes), *exact};
}

std::vector<Attitude> cardinal_attitudes() {
  std::vector<Attitude> all;
  const TestPlan cube = preset_plan("twentyfour", {}).value();
  for (const Position& p : cube.positions) all.push_back({p.axes, p.R_lp});
  return all;
}

std::vector<Attitude> all_attitudes() {
  const std::vector<Attitude> cardinal = cardinal_attitudes();
  std::vector<Attitude> all = cardinal;
  for (int axis = 0; axis < 3; ++axis)
    for (const Attitude& a : cardinal)
      all.push_back(
          attitude_of(a.R_lp * rotation<double>(0.25 * std::numbers::pi * Vec3::Unit(axis)))
              .value());
  return all;
}

}  // namespace drift::planning
