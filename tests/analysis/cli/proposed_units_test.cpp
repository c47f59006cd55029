// `driftscope look` proposes the units that the values have, not those that they are called.
#include <fmt/format.h>

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

}  // namespace
}  // namespace drift::proposed_units_test
