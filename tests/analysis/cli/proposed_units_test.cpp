// `driftscope look` proposes the units that the values have, not those that they are called, and
// takes numbers of nothing but nines for what was not measured.
#include <fmt/format.h>

#include <sstream>

#include "core/recording/recording.hpp"
#include "tests/support/program.hpp"

namespace drift::proposed_units_test {
namespace {

using test::driftscope, test::ScratchFolder;

TEST(ProposedUnits, KelvinsThatTheFileCallsDegreesCelsiusAreProposedAsKelvins) {
  const ScratchFolder folder;
  for (const std::string header : {"T_box (degC)", "temperature [degC]", "Temp_degC"}) {
    std::string rows = "time [s],position,acc_x [g],acc_y [g],acc_z [g]," + header + "\n";
    for (int i = 0; i < 12; ++i)
      rows += fmt::format("{},1,0.0{},0,1,29{}.5\n", 60 * (i + 1), i, i % 5);
    const std::string log = folder.write("log.csv", rows), file = folder.file("out.csv");
    const auto look = driftscope("look '" + log + "'");
    const auto begin = look.out.find("[recording]");
    ASSERT_NE(begin, std::string::npos) << look.out;
    const std::string section = look.out.substr(begin, look.out.find("\n\n", begin) - begin);
    EXPECT_NE(section.find("[K]\""), std::string::npos) << look.out;
    EXPECT_EQ(look.out.find("It is not a recording yet"), std::string::npos) << look.out;
    const auto convert =
        driftscope("convert '" + folder.write("lab.toml", test::cheap_study() + section + "\n") +
                   "' '" + log + "' -o '" + file + "'");
    ASSERT_EQ(convert.code, 0) << header << convert.err << section;
    EXPECT_NEAR(read_recording(file, RecordingKind::platform, 9.81).find("temperature")->values[0],
                290.5 - 273.15, 1e-6);
  }
}

/// A log of 12 rows in two positions with a cell of the accelerometer and one of the thermometer
/// in their seventh row.
std::string log_with(const std::string& acc, const std::string& temperature) {
  std::string rows = "time [s],position,acc_x [g],acc_y [g],acc_z [g],temperature [degC]\n";
  for (int i = 0; i < 12; ++i)
    rows += fmt::format("{},{},{},0,1,{}\n", 60 * (i + 1), 1 + i / 8,
                        i == 6 ? acc : fmt::format("0.00{}", i),
                        i == 6 ? temperature : fmt::format("2{}.5", i % 5));
  return rows;
}

TEST(ProposedUnits, NumbersOfNinesFarFromAllOthersAreProposedAsMissing) {
  const ScratchFolder folder;
  const std::string log = folder.write("log.csv", log_with("-9999", "999.90"));
  const auto look = driftscope("look '" + log + "'");
  EXPECT_NE(look.out.find("missing = [-9999, 999.9]"), std::string::npos) << look.out;
  EXPECT_EQ(look.out.find("It is not a recording yet"), std::string::npos) << look.out;
  const auto begin = look.out.find("[recording]");
  ASSERT_NE(begin, std::string::npos) << look.out;
  const std::string section = look.out.substr(begin, look.out.find("\n\n", begin) - begin);
  const std::string file = folder.file("out.csv");
  const auto convert =
      driftscope("convert '" + folder.write("lab.toml", test::cheap_study() + section + "\n") +
                 "' '" + log + "' -o '" + file + "'");
  ASSERT_EQ(convert.code, 0) << convert.err << section;
  const Recording r = read_recording(file, RecordingKind::platform, 9.81);
  EXPECT_TRUE(std::isnan(r.find("temperature")->values[6]));
  EXPECT_NEAR(r.find("temperature")->values[5], 20.5, 1e-9);
}

TEST(ProposedUnits, NinesThatAreOneReadingAmongOthersAreNotTakenAway) {
  const ScratchFolder folder;
  const std::string log = folder.write("log.csv", log_with("0.999", "999"));
  std::string warmer = log_with("0.006", "999");  // a resistance in ohms, say
  for (std::size_t at = 0; (at = warmer.find(".5\n", at)) != std::string::npos;)
    warmer.replace(at, 2, "0");
  warmer.replace(warmer.find("temperature [degC]"), 18, "resistance");
  const auto look = driftscope("look '" + folder.write("ohms.csv", warmer) + "'");
  EXPECT_EQ(look.out.find("\nmissing ="), std::string::npos) << look.out;
  EXPECT_NE(driftscope("look '" + log + "'").out.find("\nmissing = [999]"), std::string::npos);
  // Nor where another column reads that number.
  std::string beside, line;
  std::istringstream rows(log_with("0.006", "999"));
  while (std::getline(rows, line))
    beside += line + (beside.empty() ? ",pressure [hPa]\n" : ",999\n");
  EXPECT_EQ(driftscope("look '" + folder.write("air.csv", beside) + "'").out.find("\nmissing ="),
            std::string::npos)
      << beside;
}

}  // namespace
}  // namespace drift::proposed_units_test
