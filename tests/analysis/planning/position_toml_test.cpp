#include "analysis/planning/position_toml.hpp"

#include <gtest/gtest.h>

#include "mc/study/study.hpp"
#include "tests/support/program.hpp"

namespace drift::planning::position_toml_test {
namespace {

TEST(PositionToml, ReadsBackAsThePositions) {
  std::string why;
  std::vector<Position> written(4);
  written[0].name = "a \"quoted\" \\ name";
  written[0].axes = "x=UN y=W z=US";
  written[0].dwell = 1234.5;
  written[0].sample = 0.1;
  written[0].case_heading = 123.456789012345 * detail::deg;
  written[1].name = "slewed";
  written[1].axes = "x=N y=W z=U";
  written[1].dwell = 7200.0;
  written[1].mode = CommandLaw::level;
  written[1].entry = Entry::torqued;
  // Angles that no double of degrees says shorter, and more than one turn.
  const AxisTurn tilt{"0.1 rad about y", 1, 0.1},
      more{"-7.123456789012345678 deg about x", 0, -7.123456789012345678 * detail::deg};
  written[2].name = "turned";
  written[2].axes = "x=N y=W z=U";
  written[2].turns = {tilt};
  written[3].name = "turned twice";
  written[3].axes = "x=UN y=W z=US";
  written[3].turns = {tilt, more};
  const test::ScratchFolder folder;
  const mc::Study study = mc::read_study(folder.write(
      "s.toml", "schema = 1\n[site]\nlatitude = \"45 deg\"\n[plan]\n" + positions_toml(written) +
                    "[[filter]]\nname = \"f\"\ncoupling = \"eq5\"\n"));
  ASSERT_EQ(study.plan.positions.size(), written.size());
  for (std::size_t k = 0; k < written.size(); ++k) {
    const Position &is = study.plan.positions[k], &was = written[k];
    EXPECT_EQ(is.name, was.name);
    EXPECT_EQ(attitude_text(is), attitude_text(was));
    EXPECT_EQ(is.R_lp, parse_axes(was.axes, why).value() * rotation_of(was.turns));
    EXPECT_DOUBLE_EQ(is.dwell, was.dwell);
    EXPECT_DOUBLE_EQ(is.sample, was.sample);
    EXPECT_EQ(is.mode, was.mode);
    EXPECT_EQ(is.entry, was.entry);
    ASSERT_EQ(is.case_heading.has_value(), was.case_heading.has_value());
    // Twelve digits, three of them before the point.
    if (was.case_heading) {
      EXPECT_NEAR(*is.case_heading, *was.case_heading, 0.51e-9 * detail::deg);
    }
  }
}

}  // namespace
}  // namespace drift::planning::position_toml_test
