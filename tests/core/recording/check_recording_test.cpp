// Recordings that were made in memory are looked over as files are.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "core/plan/timeline.hpp"
#include "recording_fixture.hpp"

namespace drift::check_recording_test {
namespace {

using namespace test;

constexpr double infinite = std::numeric_limits<double>::infinity(),
                 missing = std::numeric_limits<double>::quiet_NaN();

Recording strapdown() {
  Recording r;
  r.channels.push_back({"time", unit::s, {0.0, 0.01, 0.02}});
  for (const char* name : {"gyro_x", "gyro_y", "gyro_z", "acc_x", "acc_y", "acc_z"})
    r.channels.push_back({name, *parse_unit(name[0] == 'g' ? "rad/s" : "g"), {0.0, 0.1, missing}});
  return r;
}

std::vector<double>& column(Recording& r, std::string_view name) {
  return std::ranges::find(r.channels, name, &Channel::name)->values;
}
void leave_out(Recording& r, std::string_view begin) {
  std::erase_if(r.channels, [&](const Channel& c) { return c.name.starts_with(begin); });
}

/// The refusal; empty if there is none.
std::string refusal(const Recording& r, RecordingKind kind = RecordingKind::platform) {
  try {
    check_recording(r, kind);
    return "";
  } catch (const InputError& e) {
    EXPECT_EQ(e.code(), ExitCode::recording);
    for (const std::string& m : e.messages()) {
      EXPECT_NE(m.find(" (expected "), std::string::npos) << m;
      EXPECT_EQ(m.find("recording:"), 0u) << m;
    }
    return e.what();
  }
}

TEST(CheckRecording, WhatIsAsFilesAreReadPasses) {
  EXPECT_EQ(refusal(platform_recording()), "");
  EXPECT_EQ(refusal(strapdown(), RecordingKind::strapdown), "");
  Recording r = platform_recording();
  r.lines.assign(r.rows(), 7);
  r.begins.assign(r.rows(), 0.0);
  std::ranges::fill(column(r, "gimbal_inner"), missing);
  std::ranges::fill(column(r, "temperature"), missing);
  EXPECT_EQ(refusal(r), "");
  for (const char* sensors : {"acc_", "cmd_", "phase", "case_heading"}) {
    Recording without = platform_recording();
    leave_out(without, sensors);
    EXPECT_EQ(refusal(without), "") << sensors;
  }
}

TEST(CheckRecording, EveryMistakeIsSaid) {
  const std::pair<std::function<void(Recording&)>, const char*> cases[] = {
      {[](Recording& r) { r.channels.clear(); }, "recording: there is no channel"},
      {[](Recording& r) { leave_out(r, "time"); }, "recording:time: the column is missing"},
      {[](Recording& r) { leave_out(r, "position"); }, "recording:position: the column is missing"},
      {[](Recording& r) { leave_out(r, "cmd_y"); },
       "recording:cmd_y: the column is missing while other commanded rates are there"},
      {[](Recording& r) {
         leave_out(r, "acc_");
         leave_out(r, "gimbal_");
       },
       "there are neither accelerometers nor gimbal angles"},
      {[](Recording& r) { column(r, "acc_x").resize(5); },
       "recording:acc_x: 5 values (expected 40, as in time)"},
      {[](Recording& r) { column(r, "time").push_back(1e6); }, "recording:position, phase, acc_x"},
      {[](Recording& r) {
         r.lines = {1, 2};
       },
       "recording:lines: 2 values (expected 40, as in time, or none)"},
      {[](Recording& r) { r.samples = {1.0}; }, "recording:samples: 1 values"},
      {[](Recording& r) {
         for (Channel& c : r.channels) c.values.clear();
       },
       "recording: there are no rows"},
      {[](Recording& r) { std::swap(column(r, "time")[3], column(r, "time")[7]); },
       "recording:5:time: 300 s comes after 480 s at 4"},
      {[](Recording& r) { column(r, "time")[3] = column(r, "time")[2]; },
       "recording:4:time: 180 s repeats 180 s at 3"},
      {[](Recording& r) { column(r, "time")[3] = missing; },
       "recording:4:time: the time is missing"},
      {[](Recording& r) { column(r, "time").back() = infinite; },
       "recording:40:time: the value is infinite"},
      {[](Recording& r) { column(r, "acc_x")[3] = -infinite; },
       "recording:4:acc_x: the value is infinite (expected a finite number)"},
      {[](Recording& r) { column(r, "wobble")[3] = infinite; }, "recording:4:wobble: the value"},
      {[](Recording& r) { column(r, "cmd_x")[3] = missing; },
       "recording:4:cmd_x: the command is missing"},
      {[](Recording& r) { column(r, "position")[3] = missing; },
       "recording:4:position: no position is given"},
      {[](Recording& r) { column(r, "position")[3] = 1.5; },
       "recording:4:position: the position is 1.5"},
      {[](Recording& r) { column(r, "position")[3] = 2.0; },
       "recording:5:position: position 1 comes after 2"},
      {[](Recording& r) { column(r, "phase")[3] = 2.0; }, "recording:4:phase: the phase is 2"}};
  for (const auto& [spoil, words] : cases) {
    Recording r = platform_recording();
    spoil(r);
    const std::string said = refusal(r);
    EXPECT_NE(said.find(words), std::string::npos) << words << "\nin: " << said;
  }
}

TEST(CheckRecording, OfACaseNeedsItsSensorsAndNoPosition) {
  const auto said = [](const std::function<void(Recording&)>& spoil) {
    Recording r = strapdown();
    spoil(r);
    return refusal(r, RecordingKind::strapdown);
  };
  EXPECT_NE(said([](Recording& r) { leave_out(r, "gyro_"); }).find("gyro_x, gyro_y, gyro_z"),
            std::string::npos);
  EXPECT_NE(said([](Recording& r) { leave_out(r, "acc_z"); }).find("acc_z: the column is missing"),
            std::string::npos);
  EXPECT_NE(said([](Recording& r) {
              for (Channel& c : r.channels) c.values.resize(1);
            }).find("there is one row (expected at least two"),
            std::string::npos);
  EXPECT_NE(said([](Recording& r) { column(r, "gyro_y")[1] = infinite; }).find("2:gyro_y"),
            std::string::npos);
}

/// Who lays one out unseen is stopped before memory is touched that is not there.
TEST(CheckRecording, WhatCannotBeLaidOutBreaksAContract) {
  const TestPlan plan = preset_plan("six", {}).value();
  for (const char* name : {"time", "position"}) {
    Recording r = platform_recording();
    leave_out(r, name);
    EXPECT_THROW(lay_out(r, plan, Site{}), ContractError) << name;
  }
  Recording r = platform_recording();
  column(r, "cmd_z").resize(3);
  EXPECT_THROW(lay_out(r, plan, Site{}), ContractError);
}

}  // namespace
}  // namespace drift::check_recording_test
