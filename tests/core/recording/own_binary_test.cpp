// HDF5 and MATLAB files whose columns have names of their own.
#include <gtest/gtest.h>

#include <map>

#include "core/recording/own/guess.hpp"
#include "recording_fixture.hpp"

namespace drift::own_binary_test {
namespace {

using namespace test;

/// Two positions of a platform that stands level, the second one turned about z.
Recording level_platform() {
  Recording r;
  const auto add = [&](const char* name, const char* unit, auto value) {
    Channel c{name, *parse_unit(unit), {}};
    for (int i = 0; i < 40; ++i) c.values.push_back(value(i));
    r.channels.push_back(std::move(c));
  };
  const auto none = [](int i) { return 1e-5 * std::sin(1.7 * i); };
  add("Zeit", "s", [](int i) { return 60.0 * (i + 1); });
  add("Lage", "1", [](int i) { return i < 20 ? 1.0 : 2.0; });
  add("ax", "mg", none);
  add("ay", "mg", none);
  add("az", "mg", [&](int i) { return 1.0 + none(i); });
  add("Aussen", "deg", none);
  add("Mitte", "deg", none);
  add("Innen", "deg", [&](int i) { return (i < 20 ? 0.0 : 1.5) + none(i); });
  add("T", "degC", [](int i) { return 20.0 + 0.01 * i; });
  return r;
}

TEST(OwnBinary, NamesAreGuessedAsThoseOfTextFilesAre) {
  const Folder folder;
  const Recording truth = level_platform();
  const std::map<std::string, std::string> expected{{"Zeit", "time"},
                                                    {"Lage", "position"},
                                                    {"ax", "acc_x"},
                                                    {"ay", "acc_y"},
                                                    {"az", "acc_z"},
                                                    {"Aussen", "gimbal_outer"},
                                                    {"Mitte", "gimbal_middle"},
                                                    {"Innen", "gimbal_inner"},
                                                    {"T", "temperature"}};
  for (const char* name : {"own.h5", "own.mat"}) {
    const std::string path = folder / name;
    write_recording(truth, path);
    const GuessedFile file = guess_file(path);
    EXPECT_FALSE(file.text) << name;
    EXPECT_TRUE(file.complete) << name;
    EXPECT_EQ(file.rows, 40u) << name;
    std::map<std::string, std::string> got;
    for (const GuessedColumn& c : file.columns) got[c.header.name] = c.channel;
    EXPECT_EQ(got, expected) << name;
    EXPECT_NE(recording_section(file).find("acc_x = \"ax [mg]\""), std::string::npos)
        << recording_section(file);
    const Recording r = read_recording(path, file.format, RecordingKind::platform, gravity);
    for (const auto& [own, channel] : expected) {
      ASSERT_NE(r.find(channel), nullptr) << name << " " << channel;
      const auto &is = r.find(channel)->values, &was = truth.find(own)->values;
      for (std::size_t i = 0; i < 40; ++i)  // what is written may be off in the last place
        EXPECT_LE(ulps(is[i], was[i]), 2.0) << name << " " << channel;
    }
  }
}

TEST(OwnBinary, WhatIsNoFileOfColumnsIsRefusedAsInReadingIt) {
  const Folder folder;
  const std::string path = folder.write("own.h5", "no HDF5 file");
  try {
    guess_file(path);
    FAIL() << "guessed";
  } catch (const InputError& e) {
    EXPECT_EQ(e.what(), answer(path, RecordingKind::platform).text);
  }
}

}  // namespace
}  // namespace drift::own_binary_test
