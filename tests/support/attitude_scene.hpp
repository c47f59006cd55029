#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "core/base/check.hpp"
#include "core/plan/attitude_check.hpp"
#include "core/sim/measurements.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::test {

/// Twelve positions as an ideal platform shows them.
struct AttitudeScene {
  TestPlan plan;
  Recording recording;

  /// dwell [s]
  explicit AttitudeScene(const char* preset = "twelve", double dwell = PlanDefaults{}.dwell)
      : plan(preset_plan(preset, PlanDefaults{.dwell = dwell}).value()) {
    const Timeline timeline = lay_out(plan, harbin);
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
      lay_out(recording, plan, harbin);
    } catch (const InputError& e) {
      std::vector<RowMistake> all;
      for (const std::string& m : e.messages()) all.push_back({0, m});
      return all;
    }
    return {};
  }
};

inline void expect_part(const std::string& text, const char* part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

/// What is said where something was done to the columns of gimbals or heading; the case turns.
inline std::string said_of(const std::function<void(AttitudeScene&)>& spoil) {
  AttitudeScene s;
  Channel heading;
  heading.name = "case_heading";
  heading.unit = "deg"_unit;
  const Timeline timeline = lay_out(s.plan, harbin);
  for (std::size_t k = 0; k < timeline.intervals.size(); ++k) {
    const auto& i = timeline.intervals[k];
    const double turned = 0.3 + 0.2 * static_cast<double>(i.position);
    const Vec3 phi = gimbal_angles<double>(case_attitude(turned).transpose() *
                                           timeline.nodes[i.last_node()].R_lr);
    heading.values.push_back(turned);
    int a = 0;
    for (const char* name : {"gimbal_outer", "gimbal_middle", "gimbal_inner"})
      s.column(name)[k] = phi[a++];
  }
  std::erase_if(s.recording.channels, [](const Channel& c) { return c.name == "case_heading"; });
  s.recording.channels.push_back(heading);
  spoil(s);
  const auto wrong = s.mistakes();
  EXPECT_LE(wrong.size(), 1u);
  return wrong.empty() ? "" : wrong.front().text;
}

}  // namespace drift::test
