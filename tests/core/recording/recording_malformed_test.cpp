#include <gtest/gtest.h>

#include "recording_fixture.hpp"

namespace drift::recording_malformed_test {
namespace {

using namespace test;

const std::string header = "time [s],position,phase,acc_x [g],acc_y [g],acc_z [g]\n";
const std::string imu =
    "time [s],gyro_x [deg/s],gyro_y [deg/s],gyro_z [deg/s],acc_x [g],acc_y [g],acc_z [g]\n";

struct Case {
  const char* name;
  std::string text;
  const char* where;     ///< after the file name: line and column
  const char* wrong;     ///< what was found
  const char* expected;  ///< within "(expected ...)"
  RecordingKind kind = RecordingKind::platform;
  /// An '@' of the text stands for so many digits: every test of the program starts with all cases.
  std::size_t digits = 0;
};

std::string written_out(const Case& c) {
  std::string text = c.text;
  if (c.digits > 0) text.replace(text.find('@'), 1, std::string(c.digits, '7'));
  return text;
}

constexpr auto strapdown = RecordingKind::strapdown;

std::vector<Case> cases() {
  using namespace std::string_literals;
  std::string many = header;
  for (int i = 0; i < 200; ++i) many += "x,1,0,0,0,0\n";
  // Two rows in every minute but one: what is written tells no even distance.
  std::string minutes = header;
  for (int i = 0; i < 80; ++i)
    if (i != 31) minutes += fmt::format("{},1,{},0,0,0\n", 60 * (i / 2), 1e-3 * i);
  std::string facts;
  for (int i = 0; i < 1001; ++i) facts += "# k" + std::to_string(i) + " = 1\n";
  return {
      {"RowTooShort", header + "1,1,0,0,0,0\n2,1,0,0,0\n3,1,0,0,0,0\n", ":3:", "5 cells",
       "6, as in"},
      {"RowTooLong", header + "1,1,0,0,0,0,7\n", ":2:", "7 cells", "6, as in"},
      {"InfiniteValue", header + "1,1,0,inf,0,0\n", ":2:acc_x:", "infinite", "finite"},
      {"NegativeInfinity", header + "1,1,0,0,-Infinity,0\n", ":2:acc_y:", "infinite", "finite"},
      {"NumberTooLarge", header + "1,1,0,1e999,0,0\n", ":2:acc_x:", "'1e999'", "a number between"},
      {"TimeMissing", header + ",1,0,0,0,0\n", ":2:time:", "missing", "a number in every row"},
      {"TimeNan", header + "nan,1,0,0,0,0\n", ":2:time:", "missing", "a number in every row"},
      {"TimeInfinite", header + "1,1,0,0,0,0\ninf,1,0,0,0,0\n", ":3:time:", "infinite", "finite"},
      {"TimeRepeats", header + "1,1,0,0,0,0\n1,1,0,0,0,0\n", ":3:time:", "repeats", "increase"},
      {"TimeTooCoarse", minutes, ":3:time:", "the times of 39 of 79 rows", "tell the rows apart"},
      {"TimeReversed", header + "5,1,0,0,0,0\n4,1,0,0,0,0\n", ":3:time:", "4 s comes after 5 s",
       "increase"},
      {"TimeWraps", header + "9,1,0,0,0,0\n10,1,0,0,0,0\n0.5,1,0,0,0,0\n", ":4:time:", "at 3",
       "increase"},
      {"UnitMissing", "time [s],position,acc_x,acc_y [g],acc_z [g]\n1,1,0,0,0\n",
       ":acc_x:", "missing", "specific force"},
      {"TimeUnitMissing", "time,position,acc_x [g],acc_y [g],acc_z [g]\n1,1,0,0,0\n",
       ":time:", "missing", "a time"},
      {"UnitUnknown", "time [fortnight],position,acc_x [g],acc_y [g],acc_z [g]\n1,1,0,0,0\n",
       ":time:", "'fortnight'", "a time"},
      {"UnitEmpty", "time [],position,acc_x [g],acc_y [g],acc_z [g]\n1,1,0,0,0\n",
       ":time:", "unknown unit ''", "a time"},
      {"UnitDimension", "time [deg],position,acc_x [g],acc_y [g],acc_z [g]\n1,1,0,0,0\n",
       ":time:", "[deg]", "a time"},
      {"UnitNotClosed", "time [s,position,acc_x [g],acc_y [g],acc_z [g]\n1,1,0,0,0\n",
       ":1:'time':", "'time [s'", "name [unit]"},
      {"GyroInG",
       "time [s],gyro_x [g],gyro_y [deg/s],gyro_z [deg/s],acc_x [g],acc_y [g],acc_z "
       "[g]\n1,0,0,0,0,0,0\n2,0,0,0,0,0,0\n",
       ":gyro_x:", "[g]", "angular rate", strapdown},
      {"PositionWithUnit", "time [s],position [m],acc_x [g],acc_y [g],acc_z [g]\n1,1,0,0,0\n",
       ":position:", "[m]", "plain number"},
      {"TemperatureInGauss",
       "time [s],position,acc_x [g],acc_y [g],acc_z [g],temperature [gauss]\n1,1,0,0,0,3\n",
       ":temperature:", "[gauss]", "a temperature"},
      {"NoTime", "position,acc_x [g],acc_y [g],acc_z [g]\n1,0,0,0\n", ":time:", "missing",
       "columns found: position, acc_x"},
      {"NoPosition", "time [s],acc_x [g],acc_y [g],acc_z [g]\n1,0,0,0\n", ":position:", "missing",
       "columns found: time"},
      {"NoSensor", "time [s],position\n1,1\n", ":acc_x:", "neither accelerometers nor gimbal",
       "gimbal_outer"},
      {"StrapdownAccelerometerTriple",
       "time [s],gyro_x [deg/s],gyro_y [deg/s],gyro_z [deg/s],acc_x [g],acc_z "
       "[g]\n1,0,0,0,0,0\n2,0,0,0,0,0\n",
       ":acc_y:", "missing while other accelerometers", "all three or none", strapdown},
      {"CommandTriple",
       "time [s],position,acc_x [g],acc_y [g],acc_z [g],cmd_x [deg/h]\n1,1,0,0,0,0\n",
       ":cmd_y, cmd_z:", "missing while", "all three"},
      {"StrapdownWithoutGyros", "time [s],acc_x [g],acc_y [g],acc_z [g]\n1,0,0,0\n2,0,0,0\n",
       ":gyro_x, gyro_y, gyro_z:", "missing", "columns found", strapdown},
      {"StrapdownGyroTriple",
       "time [s],gyro_x [deg/s],acc_x [g],acc_y [g],acc_z [g]\n1,0,0,0,0\n2,0,0,0,0\n",
       ":gyro_y, gyro_z:", "missing while", "all three", strapdown},
      {"StrapdownOneRow", imu + "1,0,0,0,0,0,1\n", ": ", "one row", "at least two", strapdown},
      {"CommandMissing",
       "time [s],position,acc_x [g],acc_y [g],acc_z [g],cmd_x [deg/h],cmd_y [deg/h],cmd_z "
       "[deg/h]\n1,1,0,0,0,0,,0\n",
       ":2:cmd_y:", "missing", "in every row"},
      {"DecimalCommaComma", header + "1,5,1,0,0,1,0,2,0,3\n", ":2:", "10 cells", "6, as in"},
      {"Utf16OneColumn", "\xFF\xFEt\0i\0"s, ":1:", "one column", "separated by"},
      {"BothDecimalMarks",
       "time [s];position;acc_x [g];acc_y [g];acc_z [g]\n1,5;1;0;0;0\n2;1;0.5;0;0\n",
       ":3:", "decimal points here, decimal commas in line 2", "one of the two"},
      {"Utf16WithoutMark", "t\0i\0m\0e\0"s, ":1:2:", "NUL", "UTF-8"},
      {"NulInRow", header + "1,1,0,0\0,0,0\n"s, ":2:8:", "NUL", "UTF-8"},
      {"ControlCharacter", header + "1,1,0,\x07,0,0\n", ":2:7:", "control character", "UTF-8"},
      {"CarriageReturnInside", "time [s],position\r1,1\n2,1\n", ":1:18:", "carriage return",
       "LF or CRLF"},
      {"LongLine", "@", ":1:", "longer than", "one sample per line", RecordingKind::platform,
       1'000'000},
      {"LongLineInside", header + "1,1,0,0,0,0\n@\n2,1,0,0,0\n", ":3:", "longer than",
       "one sample per line", RecordingKind::platform, 10'000'000},
      {"NothingAtAll", "", ":1:", "no header", "a row such as"},
      {"CommentsOnly", "# a = 1\n\n# b\n", ":1:", "no header", "a row such as"},
      {"HeaderOnly", header, ": ", "no rows", "one row per sample"},
      {"NoHeader", "1,1,0,0,0,0\n2,1,0,0,0,0\n", ":1:", "the number '1'", "a header row"},
      {"OneColumn", "time [s]\n1\n", ":1:", "one column", "separated by commas"},
      {"DuplicateColumn",
       "time [s],position,acc_x [g],acc_y [g],acc_z [g],acc_x [g]\n1,1,0,0,0,0\n",
       ":acc_x:", "columns 3 and 6", "every name once"},
      {"EmptyHeaderCell", "time [s],position,acc_x [g],acc_y [g],acc_z [g],\n1,1,0,0,0,7\n",
       ":1:", "cell 6 of the header is empty", "name [unit]"},
      {"TextInCell", header + "1,1,0,zero,0,0\n", ":2:acc_x:", "'zero'",
       "a number, nan or an empty cell"},
      {"NumberWithUnit", header + "1,1,0,1.5 g,0,0\n", ":2:acc_x:", "'1.5 g'", "a number"},
      {"HexNumber", header + "1,1,0,0x10,0,0\n", ":2:acc_x:", "'0x10'", "a number"},
      {"TwoSigns", header + "1,1,0,+-1,0,0\n", ":2:acc_x:", "'+-1'", "a number"},
      {"NotAvailable", header + "1,1,0,N/A,0,0\n", ":2:acc_x:", "'N/A'", "empty cell"},
      {"PositionZero", header + "1,0,0,0,0,0\n", ":2:position:", "is 0", "whole number from 1"},
      {"PositionFraction", header + "1,1.5,0,0,0,0\n", ":2:position:", "is 1.5", "whole number"},
      {"PositionMissing", header + "1,,0,0,0,0\n", ":2:position:", "no position is given",
       "whole number"},
      {"PositionHuge", header + "1,1e300,0,0,0,0\n", ":2:position:", "1e+300", "whole number"},
      {"PositionDecreases", header + "1,2,0,0,0,0\n2,1,0,0,0,0\n",
       ":3:position:", "1 comes after 2", "order in which they were held, 2, 1, and number"},
      {"PhaseTwo", header + "1,1,2,0,0,0\n", ":2:phase:", "is 2", "0 (dwell) or 1 (slew)"},
      {"PhaseMissing", header + "1,1,,0,0,0\n", ":2:phase:", "is nan", "0 (dwell)"},
      {"NothingMeasured", header + "1,1,0,,,\n2,1,0,nan,nan,nan\n", ": ",
       "no accelerometer or gimbal", "numbers in at least one"},
      {"TooManyFacts", facts + header + "1,1,0,0,0,0\n", ":1001:", "one fact too many",
       "at most 1000"},
      {"ManyProblems", many, ":2:time:", "(199 more of the kind, the last in line 201)",
       "a number"},
      {"BinaryInCsv", "\x89HDF\r\n\x1A\n", ":1:", "one column", "separated by"},
  };
}

class MalformedCsv : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Recording, MalformedCsv, ::testing::ValuesIn(cases()),
                         [](const auto& one) { return std::string(one.param.name); });

TEST_P(MalformedCsv, IsRefusedWithPlaceExpectationAndRemedy) {
  const Case& c = GetParam();
  const Folder folder;
  const std::string path = folder.write("bad.csv", written_out(c));
  const Reading a = answer(path, c.kind);
  EXPECT_EQ(a.code, static_cast<int>(ExitCode::recording)) << a.text;
  EXPECT_NE(a.text.find(path + c.where), std::string::npos) << a.text;
  EXPECT_NE(a.text.find(c.wrong), std::string::npos) << a.text;
  const auto expected = a.text.find("(expected ");
  ASSERT_NE(expected, std::string::npos) << a.text;
  EXPECT_NE(a.text.find(c.expected, expected), std::string::npos) << a.text;
  const auto fix = a.text.find("). ", expected);  // a sentence follows
  ASSERT_NE(fix, std::string::npos) << a.text;
  EXPECT_TRUE(std::isupper(static_cast<unsigned char>(a.text.at(fix + 3)))) << a.text;
}

TEST(MalformedRecording, AllProblemsAreReportedAtOnce) {
  const Folder folder;
  const std::string path =
      folder.write("bad.csv",
                   "time [s],position,acc_x [G],acc_y [g],acc_z "
                   "[g]\n1,1,0,0,0\n2,0,0,0,0\n2,1,0,oops,0\n3,1,0,0\n1,1,0,0,0\n");
  const Reading a = answer(path, RecordingKind::platform);
  for (const char* part :
       {"unknown unit 'G'", ":3:position:", ":4:acc_y:", ":5: 4 cells", ":6:time:"})
    EXPECT_NE(a.text.find(part), std::string::npos) << part << " in\n" << a.text;
}

TEST(MalformedRecording, TheSameMistakeInSeveralColumnsIsOneMessage) {
  const Folder folder;
  const std::string path = folder.write(
      "t.csv",
      "time [s],gyro_x [deg/s],gyro_y [deg/s],gyro_z [deg/s],acc_x [gee],acc_y [gee],acc_z [gee]\n"
      "1,0.1,0.2,0.3,0,0,1\n2,0.1,0.2,0.3,0,0,1\n");
  const Reading a = answer(path, strapdown);
  EXPECT_EQ(a.code, static_cast<int>(ExitCode::recording));
  EXPECT_NE(a.text.find("t.csv:acc_x, acc_y, acc_z: unknown unit 'gee'"), std::string::npos)
      << a.text;
  EXPECT_EQ(a.text.find("gee", a.text.find("'gee'") + 5), std::string::npos) << a.text;
}

TEST(MalformedRecording, ValuesBeyondReasonAreOneMessageWhateverTheyAre) {
  const test::Folder folder;  // kelvins, each another number
  std::string text = "time [s],position,acc_x [g],acc_y [g],acc_z [g],temperature [degC]\n";
  for (int i = 1; i <= 20; ++i) text += fmt::format("{},1,0,0,1,{}\n", i, 293.15 + 0.25 * i);
  const std::string said = answer(folder.write("k.csv", text), RecordingKind::platform).text;
  EXPECT_NE(said.find("k.csv:2:temperature: the value 293.4 is beyond reason"), std::string::npos)
      << said;
  EXPECT_NE(said.find("(19 more of the kind, the last in line 21)"), std::string::npos) << said;
  EXPECT_EQ(said.find("beyond reason"), said.rfind("beyond reason")) << said;
}

TEST(MalformedRecording, WhatCannotBeReadIsAnIoError) {
  const Folder folder;
  std::filesystem::create_directory(folder / "dir.csv");
  for (const std::string& path : {folder / "none.csv", folder / "none.h5", folder / "none.mat",
                                  folder / "dir.csv", std::string("/dev/null"), std::string()}) {
    const Reading a = answer(path, RecordingKind::platform);
    EXPECT_EQ(a.code, static_cast<int>(ExitCode::io)) << path << ": " << a.text;
    EXPECT_NE(a.text.find("cannot be read"), std::string::npos) << a.text;
  }
}

TEST(MalformedRecording, AnUnknownExtensionNamesTheKnownOnes) {
  const Folder folder;
  for (const char* name : {"rec.tdms", "rec", "rec.csv.gz"}) {
    const Reading a = answer(folder.write(name, "x"), RecordingKind::platform);
    EXPECT_EQ(a.code, static_cast<int>(ExitCode::recording));
    EXPECT_NE(a.text.find("expected .csv, .h5, .hdf5 or .mat"), std::string::npos) << a.text;
  }
}

}  // namespace
}  // namespace drift::recording_malformed_test
