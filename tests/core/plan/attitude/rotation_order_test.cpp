// Gimbal angles that are those of rotations in another order.
#include "core/plan/attitude/rotation_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/physics/gimbals.hpp"
#include "core/plan/case_heading.hpp"
#include "tests/support/attitude_scene.hpp"

namespace drift::rotation_order_test {
namespace {

using test::expect_part;
using Scene = test::AttitudeScene;

/// The attitudes that the columns show, written as angles of Rz Ry Rx: each column about its axis,
/// or the outer one about z.
void write_as_zyx(Scene& s, bool outer_is_x) {
  const char* names[] = {"gimbal_outer", "gimbal_middle", "gimbal_inner"};
  for (std::size_t k = 0; k < s.recording.rows(); ++k) {
    Vec3 angles;
    for (int i = 0; i < 3; ++i) angles[i] = s.column(names[i])[k];
    const Mat3 R = gimbal_chain(angles);
    const double x = std::atan2(R(2, 1), R(2, 2)), z = std::atan2(R(1, 0), R(0, 0));
    s.column(names[0])[k] = outer_is_x ? x : z;
    s.column(names[1])[k] = -std::asin(std::clamp(R(2, 0), -1.0, 1.0));
    s.column(names[2])[k] = outer_is_x ? z : x;
  }
}

std::string said(bool outer_is_x, bool reversed_acc = false) {
  Scene s("twentyfour");
  write_as_zyx(s, outer_is_x);
  if (reversed_acc) {
    for (const char* name : {"acc_x", "acc_y", "acc_z"})
      for (double& v : s.column(name)) v = std::abs(v);
  }
  std::string all;
  for (const RowMistake& m : s.mistakes()) all += m.text + "\n";
  return all;
}

TEST(RotationOrder, AnglesOfAnotherOrderAreToldWithTheConversion) {
  const std::string of_axes = said(true);
  expect_part(of_axes,
              "rotations about z, y, x, R = Rz(gimbal_inner) Ry(gimbal_middle) "
              "Rx(gimbal_outer), not about x, y, z, R = Rx(gimbal_outer) Ry(gimbal_middle) "
              "Rz(gimbal_inner)");
  expect_part(of_axes, "gimbal_outer = atan2(-R23, R33)");
  EXPECT_EQ(of_axes.find("Is this the plan"), std::string::npos) << of_axes;
}

TEST(RotationOrder, ItIsNotAskedWhereTheAccelerometersDoNotShowThePlan) {
  EXPECT_EQ(said(true, true).find("rotations about"), std::string::npos);
}

TEST(RotationOrder, FewSightsOrThePlansOwnOrderSayNothing) {
  EXPECT_FALSE(rotation_order_behind({}));
}

}  // namespace
}  // namespace drift::rotation_order_test
