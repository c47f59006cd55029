#include "analysis/planning/shown_attitude.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/planning/attitudes.hpp"
#include "core/base/units.hpp"
#include "core/physics/gimbals.hpp"
#include "core/plan/test_plan.hpp"

namespace drift::planning {
namespace {

/// The directions nearest to the axes; empty where an axis lies between three, or they are no
/// frame.
std::optional<planning::Attitude> nearest_directions(const Mat3& R_lp) {
  const double shares = std::sin(22.5 * detail::deg);  // nearer to half way than to the other one
  planning::Attitude nearest;
  for (int axis = 0; axis < 3; ++axis) {
    std::string letters;
    for (int l = 0; l < 3; ++l)
      if (std::abs(R_lp(l, axis)) > shares) letters += (R_lp(l, axis) > 0.0 ? "NWU" : "SED")[l];
    nearest.axes += fmt::format("{}{}={}", axis == 0 ? "" : " ", "xyz"[axis], letters);
  }
  std::string why;
  const auto frame = parse_axes(nearest.axes, why);
  if (!frame) return std::nullopt;
  nearest.R_lp = *frame;
  return nearest;
}

/// Degrees as they were meant [deg], of an angle that is known to `room` [deg].
double meant(double angle, double room) {
  constexpr double fine = 0.5, coarse = 5.0, more = 1.0;
  const double near = coarse * std::round(angle / coarse);
  return room > 0.4 * fine && std::abs(angle - near) <= more + room
             ? near
             : fine * std::round(angle / fine);
}

/// The turns that make a rotation: one, if what it has about the other axes is no turn; else about
/// x, y and z, each as the last left it, as gimbals do.
std::vector<AxisTurn> turns_of(const Mat3& R, double room) {
  constexpr double no_turn = 0.5;  // [deg]
  const double room_deg = room / detail::deg;
  Vec3 angles = rotation_vector(R) / detail::deg;
  Eigen::Index axis = 0;
  const double most = angles.cwiseAbs().maxCoeff(&axis);
  if (angles.squaredNorm() - most * most <= std::pow(no_turn + room_deg, 2))
    angles = angles[axis] * Vec3::Unit(axis);
  else
    angles = gimbal_angles<double>(R) / detail::deg;
  std::vector<AxisTurn> turns;
  for (int i = 0; i < 3; ++i)
    if (const double angle = meant(angles[i], room_deg); angle != 0.0)
      turns.push_back({fmt::format("{} deg about {}", angle, "xyz"[i]), i, angle * detail::deg});
  return turns;
}

}  // namespace

bool ShownAttitude::plainer_than(const ShownAttitude& other) const {
  return turns.size() != other.turns.size() ? turns.size() < other.turns.size()
                                            : axes.size() < other.axes.size();
}

ShownAttitude shown_attitude(const Mat3& R_lp, double room) {
  constexpr double of_directions = 3.0 * detail::deg;
  if (const auto near = nearest_directions(R_lp);
      near && rotation_vector(Mat3(near->R_lp.transpose() * R_lp)).norm() <= of_directions + room)
    return {near->axes, {}, near->R_lp};
  const std::vector<planning::Attitude> all = planning::cardinal_attitudes();
  const auto start = std::ranges::max_element(
      all, {}, [&](const planning::Attitude& a) { return (a.R_lp.transpose() * R_lp).trace(); });
  const std::vector<AxisTurn> turns = turns_of(start->R_lp.transpose() * R_lp, room);
  ShownAttitude shown{start->axes, {}, start->R_lp * rotation_of(turns)};
  for (const AxisTurn& turn : turns) shown.turns.push_back(turn.text);
  return shown;
}

std::string attitude_keys(const ShownAttitude& attitude, const char* before_equals,
                          const char* between) {
  std::string text = fmt::format("axes{}= \"{}\"", before_equals, attitude.axes);
  const auto& turns = attitude.turns;
  if (turns.size() == 1)
    text += fmt::format("{}turn{}= \"{}\"", between, before_equals, turns.front());
  if (turns.size() > 1)
    text += fmt::format("{}turn{}= [\"{}\"]", between, before_equals, fmt::join(turns, "\", \""));
  return text;
}

}  // namespace drift::planning
