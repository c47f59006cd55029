// A recording whose columns are not what they are called.
#include "core/plan/attitude_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/check.hpp"
#include "core/sim/measurements.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::attitude_check_test {
namespace {

/// Twelve positions as an ideal platform shows them.
struct Scene {
  TestPlan plan = preset_plan("twelve", PlanDefaults{}).value();
  Recording recording;

  Scene() {
    const Timeline timeline = lay_out(plan, test::harbin);
    Measurements m{Mat3X(3, timeline.intervals.size()), Mat3X(3, timeline.intervals.size())};
    for (std::size_t k = 0; k < timeline.intervals.size(); ++k) {
      const Interval& i = timeline.intervals[k];
      const Mat3& R_lr = timeline.nodes[i.last_node()].R_lr;
      m.acc.col(static_cast<Eigen::Index>(k)) = R_lr.row(2).transpose();
      m.gimbal.col(static_cast<Eigen::Index>(k)) =
          gimbal_angles<double>(case_attitude(i.heading1).transpose() * R_lr);
    }
    recording = make_recording(timeline, m, Readout{});
  }
  std::vector<double>& column(const char* name) {
    return std::ranges::find(recording.channels, name, &Channel::name)->values;
  }
  void reverse(const char* name) {
    for (double& v : column(name)) v = -v;
  }
  std::vector<RowMistake> mistakes() {
    try {
      lay_out(recording, plan, test::harbin);
    } catch (const InputError& e) {
      std::vector<RowMistake> all;
      for (const std::string& m : e.messages()) all.push_back({0, m});
      return all;
    }
    return {};
  }
};

TEST(AttitudeCheck, SaysNothingOfARecordingOfThePlan) {
  EXPECT_TRUE(Scene().mistakes().empty());
}

TEST(AttitudeCheck, NamesTheColumnWhoseSignIsWrong) {
  for (const char* name : {"acc_x", "acc_y", "acc_z", "gimbal_outer", "gimbal_middle"}) {
    Scene s;
    s.reverse(name);
    const auto wrong = s.mistakes();
    ASSERT_EQ(wrong.size(), 1u) << name << ": " << wrong.front().text;
    EXPECT_NE(wrong[0].text.find(fmt::format("column {}: the sign is wrong", name)),
              std::string::npos)
        << wrong[0].text;
    EXPECT_NE(wrong[0].text.find(fmt::format("{{ {} = \"-{}\" }}", name, name)), std::string::npos)
        << wrong[0].text;
  }
}

TEST(AttitudeCheck, NamesColumnsThatAreExchanged) {
  Scene s;
  std::swap(s.column("acc_x"), s.column("acc_z"));
  const auto wrong = s.mistakes();
  ASSERT_EQ(wrong.size(), 1u);
  EXPECT_NE(wrong[0].text.find("acc_x = \"acc_z\", acc_z = \"acc_x\""), std::string::npos)
      << wrong[0].text;
}

TEST(AttitudeCheck, NamesThePositionsWhereNoMixupOfColumnsIsBehind) {
  Scene s;
  std::swap(s.plan.positions[0], s.plan.positions[2]);
  const auto wrong = s.mistakes();
  ASSERT_GE(wrong.size(), 2u);
  for (const RowMistake& m : wrong)
    EXPECT_NE(m.text.find("the order of positions"), std::string::npos) << m.text;
}

}  // namespace
}  // namespace drift::attitude_check_test
