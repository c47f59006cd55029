#include "core/recording/recording.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <clocale>
#include <csignal>
#include <cstdlib>
#include <tuple>

#include "recording_fixture.hpp"

namespace drift::recording_test {
namespace {

using namespace test;

constexpr const char* extensions[] = {".csv", ".h5", ".mat"};

void expect_same(const Recording& a, const Recording& b, double most_ulps) {
  ASSERT_EQ(a.channels.size(), b.channels.size());
  EXPECT_EQ(a.facts, b.facts);
  for (std::size_t k = 0; k < a.channels.size(); ++k) {
    const auto& c = a.channels[k];
    const Channel* other = b.find(c.name);
    ASSERT_NE(other, nullptr) << c.name;
    EXPECT_EQ(&b.channels[k], other) << c.name << ": the order of the channels changed";
    EXPECT_EQ(c.unit.symbol, other->unit.symbol) << c.name;
    ASSERT_EQ(c.values.size(), other->values.size()) << c.name;
    for (std::size_t i = 0; i < c.values.size(); ++i)
      EXPECT_LE(ulps(c.values[i], other->values[i]), most_ulps) << c.name << " row " << i;
  }
}

class EveryFormat : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Recording, EveryFormat, ::testing::ValuesIn(extensions),
                         [](const auto& one) { return std::string(one.param + 1); });

TEST_P(EveryFormat, ReadsBackWhatWasWrittenWithinOneUlp) {
  const Folder folder;
  const std::string path = folder / (std::string("rec") + GetParam());
  const Recording r = platform_recording();
  write_recording(r, path);
  const Recording back = read_recording(path, RecordingKind::platform, gravity);
  expect_same(r, back, 1.0);
  EXPECT_EQ(back.source, path);
  EXPECT_EQ(back.lines.size(), r.rows());
}

TEST_P(EveryFormat, WritingWhatWasReadGivesTheSameBytes) {
  const Folder folder;
  const std::string one = folder / (std::string("one") + GetParam());
  const std::string two = folder / (std::string("two") + GetParam());
  write_recording(platform_recording(), one);
  write_recording(read_recording(one, RecordingKind::platform, gravity), two);
  EXPECT_EQ(bytes_of(one), bytes_of(two));
  EXPECT_EQ(folder.count(), 2u) << "a temporary file is left";
}

TEST_P(EveryFormat, GivesTheVerySameNumbersAsCsv) {
  const Folder folder;
  const std::string path = folder / (std::string("rec") + GetParam());
  write_recording(platform_recording(), path);
  write_recording(platform_recording(), folder / "other.csv");
  expect_same(read_recording(path, RecordingKind::platform, gravity),
              read_recording(folder / "other.csv", RecordingKind::platform, gravity), 0.0);
}

TEST_P(EveryFormat, AFolderThatIsNotThereIsAnIoErrorAndLeavesNothing) {
  const Folder folder;
  try {
    write_recording(platform_recording(), folder / (std::string("none/rec") + GetParam()));
    FAIL() << "written into a folder that is not there";
  } catch (const InputError& e) {
    EXPECT_EQ(e.code(), ExitCode::io);
    EXPECT_NE(std::string(e.what()).find("No such file"), std::string::npos) << e.what();
  }
  EXPECT_EQ(folder.count(), 0u);
}

TEST_P(EveryFormat, WhatCannotBeCompletedLeavesTheTargetAsItWas) {
  const Folder folder;
  const std::string path = folder.write(std::string("rec") + GetParam(), "as it was");
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{2048, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);  // then writing fails with EFBIG
  ::setrlimit(RLIMIT_FSIZE, &small);
  std::string message;
  ExitCode code = ExitCode::ok;
  try {
    write_recording(platform_recording(), path);
  } catch (const InputError& e) {
    message = e.what();
    code = e.code();
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(code, ExitCode::io) << message;
  EXPECT_EQ(bytes_of(path), "as it was");
  EXPECT_EQ(folder.count(), 1u) << "a temporary file is left";
}

TEST_P(EveryFormat, StrapdownAccelerationInMetresKeepsItsUnitAndIsHeldInG) {
  const Folder folder;
  const std::string csv = folder.write("imu.csv",
                                       "time [s],gyro_x [deg/s],gyro_y [rad/s],gyro_z [deg/h],"
                                       "acc_x [m/s^2],acc_y [m/s^2],acc_z [m/s^2]\n"
                                       "0.01,180,0,3600,0,0,9.80665\n0.02,0,1,0,4.903325,,0.1\n");
  const Recording r = read_recording(csv, RecordingKind::strapdown, gravity);
  EXPECT_DOUBLE_EQ(r.find("acc_z")->values[0], 1.0);
  EXPECT_DOUBLE_EQ(r.find("acc_x")->values[1], 0.5);
  EXPECT_TRUE(std::isnan(r.find("acc_y")->values[1]));
  EXPECT_DOUBLE_EQ(r.find("gyro_x")->values[0], std::numbers::pi);
  EXPECT_DOUBLE_EQ(r.find("gyro_z")->values[0], std::numbers::pi / 180.0);
  EXPECT_TRUE(r.find("acc_x")->unit.same_dimension(unit::g));
  const std::string path = folder / (std::string("copy") + GetParam());
  write_recording(r, path);
  expect_same(r, read_recording(path, RecordingKind::strapdown, gravity), 1.0);
}

TEST(RecordingCsv, KeepsTheShortDigitsOfTheFile) {
  const Folder folder;
  const std::string text =
      "time [s],gyro_x [deg/s],gyro_y [deg/s],gyro_z [deg/s],acc_x [m/s^2],acc_y [m/s^2],acc_z "
      "[m/s^2]\n0.01,0.03515,0.1,0.7,-8.4209,0.0671,5.24511\n0.02,0.3,0.6,1e-07,0.1,0.2,9.81\n";
  const std::string path = folder.write("in.csv", text);
  write_recording(read_recording(path, RecordingKind::strapdown, gravity), folder / "out.csv");
  EXPECT_EQ(bytes_of(folder / "out.csv"), text);
}

TEST(RecordingCsv, DoesNotDependOnHowTheFileIsWritten) {
  const Folder folder;
  const std::string plain =
      "# sensor = A\ntime [s],position,acc_x [g],acc_y [g],acc_z [g]\n"
      "1,1,0.5,nan,-1e-3\n2,1,+0.25,,NaN\n";
  const Recording expected =
      read_recording(folder.write("plain.csv", plain), RecordingKind::platform, gravity);
  ASSERT_EQ(expected.rows(), 2u);
  EXPECT_EQ(expected.lines, (std::vector<std::size_t>{3, 4}));
  EXPECT_EQ(expected.find("acc_x")->values[1], 0.25);
  const auto replaced = [&](char from, const std::string& to) {
    std::string out;
    for (const char c : plain) out += c == from ? to : std::string(1, c);
    return out;
  };
  const std::string variants[] = {"\xEF\xBB\xBF" + plain, replaced('\n', "\r\n"),
                                  replaced('\n', "\r"),   replaced(',', ";"),
                                  replaced(',', "\t"),    replaced(',', " , "),
                                  replaced('\n', "\n\n"), plain.substr(0, plain.size() - 1)};
  for (const auto& text : variants) {
    SCOPED_TRACE(text);
    expect_same(expected,
                read_recording(folder.write("v.csv", text), RecordingKind::platform, gravity), 0.0);
  }
}

TEST(RecordingCsv, DoesNotDependOnTheLocale) {
  const char* const before = std::setlocale(LC_ALL, nullptr);
  const std::string saved = before == nullptr ? "C" : before;
  const Folder folder;
  // Its own where the machine has none: from the sources in the package "locales".
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) {
    std::ignore = std::system(
        ("localedef -i de_DE -f UTF-8 '" + (folder / "de_DE.UTF-8") + "' >/dev/null 2>&1").c_str());
    setenv("LOCPATH", (folder / "").c_str(), 1);
  }
  const bool comma = std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
  unsetenv("LOCPATH");
  if (!comma) GTEST_SKIP() << "no sources of a locale with a decimal comma (package locales)";
  ASSERT_STREQ(std::localeconv()->decimal_point, ",");
  write_recording(platform_recording(), folder / "rec.csv");
  const Recording back = read_recording(folder / "rec.csv", RecordingKind::platform, gravity);
  std::setlocale(LC_ALL, saved.c_str());
  expect_same(platform_recording(), back, 1.0);
}

TEST(RecordingCsv, ARepeatedFactIsJoinedAndACommentIsNone) {
  const Folder folder;
  const std::string path = folder.write(
      "f.csv",
      "# free words\n#a=1\n# a = 2 = two\ntime [s],position,acc_x [g],acc_y [g],acc_z [g]\n"
      "1,1,0,0,0\n# end = yes\n");
  const Recording r = read_recording(path, RecordingKind::platform, gravity);
  EXPECT_EQ(r.facts, (std::vector<std::pair<std::string, std::string>>{{"a", "1; 2 = two"},
                                                                       {"end", "yes"}}));
}

TEST(Recording, FactsThatAFormatCouldNotHoldAreMadePlain) {
  const Folder folder;
  Recording r = platform_recording();
  r.facts = {{"a=b", "two\nlines"}, {"", " x "}};
  for (const char* extension : extensions) {
    const std::string path = folder / (std::string("f") + extension);
    write_recording(r, path);
    EXPECT_EQ(
        read_recording(path, RecordingKind::platform, gravity).facts,
        (std::vector<std::pair<std::string, std::string>>{{"a_b", "two lines"}, {"fact", "x"}}));
  }
}

/// Runs another program's script; false with a message if the program is not there.
bool have(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

TEST(RecordingReaders, H5pyReadsTheHdf5File) {
  std::string python;
  for (const std::string name :
       {"/usr/bin/python3", "python3"})  // the distribution's has the package
    if (std::system((name + " -c 'import h5py' >/dev/null 2>&1").c_str()) == 0) python = name;
  if (python.empty()) GTEST_SKIP() << "h5py is not installed";
  const Folder folder;
  write_recording(platform_recording(), folder / "rec.h5");
  const std::string script =
      folder.write("check.py",
                   "import sys, h5py\n"
                   "f = h5py.File(sys.argv[1], 'r')\n"
                   "assert f['acc_x'].attrs['unit'] in ('mg', b'mg'), f['acc_x'].attrs['unit']\n"
                   "assert f['acc_x'].shape == (40,) and abs(f['time'][0] - 1.0) < 1e-12\n"
                   "assert f.attrs['sensor'] in ('test table', b'test table')\n"
                   "assert f['acc_x'].dims[0][0].name == '/time'\n");
  EXPECT_EQ(std::system((python + " '" + script + "' '" + (folder / "rec.h5") + "'").c_str()), 0);
}

TEST(RecordingReaders, OctaveReadsBothAndWhatItWritesIsRead) {
  if (!have("octave-cli")) GTEST_SKIP() << "Octave is not installed";
  const Folder folder;
  write_recording(platform_recording(), folder / "rec.h5");
  write_recording(platform_recording(), folder / "rec.mat");
  const std::string script = folder.write(
      "check.m",
      "cd(argv(){1});\n"
      "a = load('rec.h5'); b = load('rec.mat');\n"
      "assert(isequaln(a.acc_x(:), b.acc_x(:)) && numel(b.acc_x) == 40);\n"
      "assert(strcmp(b.units.acc_x, 'mg') && strcmp(b.units.time, 'min'));\n"
      "time = (1:5)'; position = int8(ones(5,1)); acc_x = single([.5 .25 NaN 0 1]); acc_y = "
      "time*0;\n"
      "acc_z = acc_y; units.time = 's'; acc_x_unit = 'g'; units.acc_y = 'mg'; units.acc_z = 'ug';\n"
      "facts = sprintf('sensor = A\\nsource = B');\n"
      "save('-v7', 'v7.mat', 'time', 'position', 'acc_x', 'acc_y', 'acc_z', 'units', 'acc_x_unit', "
      "'facts');\n"
      "save('-v6', 'v6.mat', 'time', 'position', 'acc_x', 'acc_y', 'acc_z', 'units', 'acc_x_unit', "
      "'facts');\n");
  ASSERT_EQ(std::system(("octave-cli -q '" + script + "' '" + (folder / "") + "'").c_str()), 0);
  for (const char* name : {"v7.mat", "v6.mat"}) {
    const Recording r = read_recording(folder / name, RecordingKind::platform, gravity);
    EXPECT_EQ(r.find("time")->values, (std::vector<double>{1, 2, 3, 4, 5}));
    EXPECT_EQ(r.find("acc_x")->values[1], 0.25);
    EXPECT_TRUE(std::isnan(r.find("acc_x")->values[2]));
    EXPECT_EQ(r.find("acc_y")->unit.symbol.view(), "mg");
    EXPECT_EQ(r.facts,
              (std::vector<std::pair<std::string, std::string>>{{"sensor", "A"}, {"source", "B"}}));
  }
}

}  // namespace
}  // namespace drift::recording_test
