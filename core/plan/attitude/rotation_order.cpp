#include "core/plan/attitude/rotation_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <string_view>

#include "core/physics/gimbals.hpp"
#include "core/plan/case_heading.hpp"
#include "core/recording/recording_channels.hpp"

namespace drift {
namespace {

/// Three rotations in the order in which they are multiplied: about which axis, by which column.
struct RotationOrder {
  std::array<int, 3> axis{0, 1, 2}, column{0, 1, 2};
  bool operator==(const RotationOrder&) const = default;

  Mat3 of(const Vec3& angles) const {
    Mat3 R = Mat3::Identity();
    for (std::size_t i = 0; i < 3; ++i)
      R = R * rotation<double>(Vec3(angles[column[i]] * Vec3::Unit(axis[i])));
    return R;
  }
  /// "Rz(gimbal_inner) Ry(gimbal_middle) Rx(gimbal_outer)".
  std::string text() const {
    std::string out;
    for (std::size_t i = 0; i < 3; ++i)
      out += fmt::format("{}R{}({})", i > 0 ? " " : "", "xyz"[axis[i]],
                         gimbal_channels.names[static_cast<std::size_t>(column[i])]);
    return out;
  }
};

bool shows_the_plan(const std::vector<Sight>& sights, const RotationOrder& order) {
  return std::ranges::all_of(sights, [&](const Sight& s) {
    const Mat3 R_lp = case_attitude(s.heading) * order.of(s.seen);
    return rotation_vector(Mat3(s.R_lr.transpose() * R_lp)).norm() < largest_mismatch;
  });
}

}  // namespace

std::optional<std::string> rotation_order_behind(const std::vector<Sight>& sights) {
  if (sights.size() < fewest_sights) return std::nullopt;
  std::vector<RotationOrder> fitting;
  std::array<int, 3> axis{0, 1, 2};
  while (std::ranges::next_permutation(axis).found)
    for (const RotationOrder& order : {RotationOrder{axis, axis}, RotationOrder{axis, {0, 1, 2}}})
      if (shows_the_plan(sights, order)) fitting.push_back(order);
  if (fitting.size() != 1) return std::nullopt;
  const auto& order = fitting.front();
  return fmt::format(
      "the angles are those of rotations about {}, {}, {}, R = {}, not about x, y, z, R = {}. "
      "Convert them: with that R, gimbal_outer = atan2(-R23, R33), gimbal_middle = asin(R13), "
      "gimbal_inner = atan2(-R12, R11)",
      "xyz"[order.axis[0]], "xyz"[order.axis[1]], "xyz"[order.axis[2]], order.text(),
      RotationOrder{}.text());
}

}  // namespace drift
