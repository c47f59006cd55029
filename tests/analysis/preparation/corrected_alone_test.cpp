// [recording] is one for all recordings: what is said where a line of it is meant for one of them.
#include <gtest/gtest.h>

#include "analysis/preparation/own_names.hpp"
#include "analysis/preparation/prepare.hpp"
#include "core/base/check.hpp"
#include "tests/support/off_zero.hpp"
#include "tests/support/program.hpp"
#include "tests/support/short_study.hpp"

namespace drift::preparation::corrected_alone_test {
namespace {

using test::driftscope;

constexpr const char* advice =
    "correct this one by itself, with the line in a copy of the study (driftscope convert "
    "COPY.toml "
    "off.csv -o corrected.csv), and give what that writes in its place";

struct OneOfTwo : testing::Test {
  mc::Study study = [] {
    PlanDefaults defaults;
    defaults.mode = CommandLaw::free;
    defaults.dwell = 600.0;
    return test::study_off_zero("twentyfour", defaults);
  }();
  Recording right = named(0.0, "right.csv", 0), off = named(1.0, "off.csv", 1);

  Recording named(double deg, const char* source, std::uint64_t run) const {
    Recording r = test::recording_off_zero(study, "gimbal_inner", deg, run);
    r.source = source;
    return r;
  }
};

TEST_F(OneOfTwo, AZeroIsCorrectedInThatFileAlone) {
  const std::string alone = prepare(study, {off}).off_zero,
                    beside = prepare(study, {right, off}).off_zero;
  EXPECT_NE(alone.find("off.csv:gimbal_inner"), std::string::npos) << alone;
  EXPECT_EQ(alone.find("convert"), std::string::npos) << alone;
  EXPECT_NE(beside.find(advice), std::string::npos) << beside;
  EXPECT_EQ(beside, prepare(study, {off, right}).off_zero);
}

TEST_F(OneOfTwo, ASignIsCorrectedInThatFileAlone) {
  off = named(0.0, "off.csv", 1);
  for (Channel& c : off.channels)
    if (c.name == "gimbal_middle")
      for (double& angle : c.values) angle = -angle;
  const auto refusal = [&](const std::vector<Recording>& recordings) -> std::string {
    try {
      prepare(study, recordings);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refusal({off}).find("[recording]"), std::string::npos) << refusal({off});
  EXPECT_EQ(refusal({off}).find("COPY.toml"), std::string::npos) << refusal({off});
  EXPECT_NE(refusal({right, off}).find(advice), std::string::npos) << refusal({right, off});
}

TEST(CorrectedAlone, IsSaidOnceOfAFileAndOfNoneThatIsAlone) {
  mc::Study study;
  const auto said = [&](const std::vector<std::string>& files) {
    std::vector<std::string> messages{"a.csv: no line is meant", "a.csv:3: write [recording].",
                                      "a.csv:4: write [recording]", "all: see [recording]"};
    correct_alone(messages, study, files);
    return messages;
  };
  EXPECT_EQ(said({"a.csv"})[1], "a.csv:3: write [recording].");
  const std::vector<std::string> both = said({"a.csv", "b.csv"});
  EXPECT_EQ(both[0], "a.csv: no line is meant");
  EXPECT_TRUE(both[1].starts_with("a.csv:3: write [recording]. [recording] is one for all"))
      << both[1];
  EXPECT_EQ(both[2], "a.csv:4: write [recording]");
  EXPECT_EQ(both[3], "all: see [recording]");
  // What was converted is not to be read by the lines of the study once more.
  study.resolved = {{"recording.delimiter", "auto", "default"}};
  EXPECT_TRUE(said({"a.csv", "b.csv"})[1].ends_with("in its place"));
  study.resolved.push_back({"recording.columns.acc_x", "Ax", "lab.toml:3"});
  EXPECT_TRUE(said({"a.csv", "b.csv"})[1].ends_with("with a study without [recording]"));
}

TEST(CorrectedAlone, WhatIsSaidWorks) {
  const test::ScratchFolder folder;
  const std::string study = folder.write("s.toml", test::short_study), a = folder.file("a.csv"),
                    b = folder.file("b.csv"), off = folder.file("off.csv"),
                    corrected = folder.file("corrected.csv");
  ASSERT_EQ(driftscope("simulate " + study + " -o " + a).code, 0);
  ASSERT_EQ(driftscope("simulate " + study + " -o " + b + " --run 1").code, 0);
  const auto convert = [&](const std::string& from, const char* zero, const std::string& to) {
    return driftscope("convert " + study + " " + from + " --set recording.offset.gimbal_inner='" +
                      zero + "' -o " + to);
  };
  ASSERT_EQ(convert(b, "20 deg", off).code, 0);
  const std::string identify = "identify " + study + " " + a + " ";
  const test::Answer refused = driftscope(identify + off + " --full");
  EXPECT_NE((refused.out + refused.err).find("COPY.toml " + off), std::string::npos)
      << refused.out << refused.err;
  ASSERT_EQ(convert(off, "-20 deg", corrected).code, 0);
  const test::Answer right = driftscope(identify + corrected + " --full");
  EXPECT_EQ(right.code, 0) << right.err;
  EXPECT_EQ((right.out + right.err).find("COPY.toml"), std::string::npos) << right.out << right.err;
}

}  // namespace
}  // namespace drift::preparation::corrected_alone_test
