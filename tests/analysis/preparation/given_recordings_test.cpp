// Recordings that were made in memory are refused in words where a file would be.
#include <gtest/gtest.h>

#include <functional>

#include "analysis/diagnosis/diagnose_recordings.hpp"
#include "analysis/identification/identify.hpp"
#include "analysis/preparation/recorded_test.hpp"
#include "analysis/strapdown/case_study.hpp"
#include "core/base/check.hpp"
#include "tests/support/rows_at_any_distance.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::preparation::given_recordings_test {
namespace {

std::string refusal(const std::function<void()>& action) {
  try {
    action();
    return "";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::recording);
    return error.what();
  }
}

struct RecordingsInMemory : testing::Test {
  mc::Study study = test::six_study();
  Recording right = test::simulated(study);

  void expect_refused(const std::vector<Recording>& recordings, const char* words) const {
    const std::function<void()> entrances[] = {
        [&] { prepare(study, recordings); }, [&] { recorded_test(study, recordings); },
        [&] { identification::identify_recordings(study, recordings, 1); },
        [&] { diagnosis::diagnose_recordings(study, recordings); },
        [&] { diagnosis::diagnose(study, recordings, {}); }};
    for (const auto& entrance : entrances) {
      const std::string said = refusal(entrance);
      EXPECT_NE(said.find(words), std::string::npos) << "expected: " << words << "\nin: " << said;
    }
  }
  void expect_refused(const std::function<void(Recording&)>& spoil, const char* words) const {
    Recording wrong = right;
    spoil(wrong);
    expect_refused({right, wrong}, words);
  }
};

TEST_F(RecordingsInMemory, NoneIsRefused) {
  expect_refused(std::vector<Recording>{}, "no recording is given (expected at least one)");
}

TEST_F(RecordingsInMemory, ThatNoFileCouldHoldAreRefused) {
  const auto leave_out = [](const char* name) {
    return [name](Recording& r) {
      std::erase_if(r.channels, [&](const Channel& c) { return c.name == name; });
    };
  };
  expect_refused([](Recording& r) { r = {}; }, "there is no channel");
  expect_refused(leave_out("time"), "recording:time: the column is missing");
  expect_refused(leave_out("position"), "recording:position: the column is missing");
  expect_refused([](Recording& r) { test::channel(r, "gimbal_inner").resize(20); },
                 "recording:gimbal_inner: 20 values (expected 120, as in time)");
  expect_refused(
      [](Recording& r) { std::swap(test::channel(r, "time")[3], test::channel(r, "time")[7]); },
      "recording:5:time: 300 s comes after 480 s at 4");
  expect_refused([](Recording& r) { test::channel(r, "acc_x")[3] = HUGE_VAL; },
                 "recording:4:acc_x: the value is infinite");
  // Each of several is named.
  Recording first = right, second = right;
  first.source = "a.csv";
  second.source = "b.csv";
  leave_out("time")(first);
  leave_out("position")(second);
  const std::string said = refusal([&] { prepare(study, {first, second}); });
  EXPECT_NE(said.find("a.csv:time"), std::string::npos) << said;
  EXPECT_NE(said.find("b.csv:position"), std::string::npos) << said;
}

TEST_F(RecordingsInMemory, NeedNoLines) {
  right.lines.clear();
  std::vector<double>& x = test::channel(right, "gimbal_inner");
  std::fill(x.begin() + 40, x.begin() + 80, x[40]);
  const Prepared p = prepare(study, {right});
  EXPECT_TRUE(test::says(p, "gimbal_inner stands still for 40 samples, from line 41 on"));
}

TEST_F(RecordingsInMemory, OfACaseAreLookedOverToo) {
  Recording r;
  for (const char* name : {"time", "gyro_x", "gyro_y", "gyro_z", "acc_x", "acc_y", "acc_z"})
    r.channels.push_back({name, name[0] == 't' ? unit::s : unit::g, {0.0, 0.5, 1.0}});
  r.channels[4].values[1] = HUGE_VAL;
  const auto said = [&] { return refusal([&] { strapdown::case_study(mc::Study{}, r); }); };
  EXPECT_NE(said().find("recording:2:acc_x: the value is infinite"), std::string::npos) << said();
  r.channels[4].values.pop_back();
  EXPECT_NE(said().find("recording:acc_x: 2 values (expected 3"), std::string::npos) << said();
  r.channels.pop_back();
  r.channels[4].values = {0.0, 0.5, 1.0};
  EXPECT_NE(said().find("recording:acc_z: the column is missing"), std::string::npos) << said();
}

}  // namespace
}  // namespace drift::preparation::given_recordings_test
