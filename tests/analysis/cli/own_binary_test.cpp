// HDF5 and MATLAB files under names of their own, as `look` and `new` take them.
#include <gtest/gtest.h>

#include "core/recording/recording.hpp"
#include "tests/support/program.hpp"

namespace drift::own_binary_file_test {
namespace {

using test::driftscope, test::ScratchFolder;

const std::string study_text = R"toml(schema = 1
[site]
latitude = "45.75 deg"
[plan]
preset = "six"
dwell = "4 min"
sample = "20 s"
[truth]
coupling = "eq5"
terms = ["fixed_drift"]
[[filter]]
coupling = "eq5"
terms = ["fixed_drift"]
)toml";

TEST(OwnBinaryFile, WhatLookProposesAndNewWritesReadsIt) {
  const ScratchFolder folder;
  const std::string study = folder.write("study.toml", study_text), made = folder.file("made.csv");
  ASSERT_EQ(driftscope("simulate '" + study + "' -o '" + made + "'").code, 0);
  const Recording truth = read_recording(made, RecordingKind::platform, 9.80665);
  Recording own;
  for (const auto& [channel, name] : {std::pair{"time", "Zeit"},
                                      {"position", "Lage"},
                                      {"acc_x", "ax"},
                                      {"acc_y", "ay"},
                                      {"acc_z", "az"},
                                      {"gimbal_outer", "Aussen"},
                                      {"gimbal_middle", "Mitte"},
                                      {"gimbal_inner", "Innen"}}) {
    own.channels.push_back(*truth.find(channel));
    own.channels.back().name = name;
  }
  for (const char* file : {"own.h5", "own.mat"}) {
    const std::string log = folder.file(file);
    write_recording(own, log);
    const auto look = driftscope("look '" + log + "'");
    ASSERT_EQ(look.code, 0) << look.err;
    const auto begin = look.out.find("[recording]");
    ASSERT_NE(begin, std::string::npos) << look.out;
    EXPECT_EQ(look.out.find("cells are divided by"), std::string::npos) << look.out;
    const std::string section = look.out.substr(begin, look.out.find("\n\n", begin) - begin);
    EXPECT_NE(section.find("gimbal_outer = \"Aussen [deg]\""), std::string::npos) << section;
    const std::string mine = folder.write("mine.toml", study_text + section + "\n"),
                      out = folder.file(std::string(file) + ".csv");
    const auto convert = driftscope("convert '" + mine + "' '" + log + "' -o '" + out + "'");
    EXPECT_EQ(convert.code, 0) << convert.err;
    const std::string fresh = folder.file(std::string(file) + ".toml");
    const auto made_study = driftscope("new diagnose '" + log + "' -o '" + fresh + "'");
    ASSERT_EQ(made_study.code, 0) << made_study.err;
    const auto again = driftscope("convert '" + fresh + "' '" + log + "' -o '" + out + "'");
    EXPECT_EQ(again.code, 0) << again.err;
  }
}

}  // namespace
}  // namespace drift::own_binary_file_test
