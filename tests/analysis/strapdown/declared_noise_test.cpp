// Gyros that see the Earth: an effect in every turn looks like more noise of the declared kind, and
// a drift beyond its prior is none.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "mc/study/study.hpp"
#include "tests/support/case_unit.hpp"
#include "tests/support/program.hpp"

namespace drift::declared_noise_test {
namespace {

TEST(DeclaredNoise, AnAsymmetryIsNoLargerNoiseOfTheGyros) {
  const test::ScratchFolder scratch;
  const std::string study =
      scratch.write("study.toml", test::strapdown_study("34.3775 deg", "9.8 m/s^2"));
  for (const double ppm : {0.0, 8.0}) {
    Theta sensors = strapdown::case_unit::sensors();
    test::set(sensors, "s_a_y", ppm);
    write_recording(strapdown_recording(strapdown::case_unit::script(21), sensors),
                    scratch.file("unit.csv"));
    const test::Answer a = test::driftscope("diagnose " + study + " " + scratch.file("unit.csv") +
                                            " -o " + scratch.file("out"));
    ASSERT_EQ(a.code, 0) << a.err;
    const auto d = nlohmann::json::parse(test::text_of(scratch.file("out/diagnosis.json")));
    if (ppm == 0.0) {
      EXPECT_EQ(d["verdict"], "consistent") << a.out;
      continue;
    }
    ASSERT_EQ(d["verdict"], "named") << a.out;
    ASSERT_EQ(d["causes"].size(), 1u);
    EXPECT_EQ(d["causes"][0]["term"], "torquer_asymmetry");
    EXPECT_EQ(d["causes"][0]["axis"], "y");
    const auto& p = d["causes"][0]["parameters"][0];
    EXPECT_NEAR(p["value"].get<double>(), ppm, 4.0 * p["sigma"].get<double>());
    EXPECT_LT(p["interval_95"][0].get<double>(), p["value"].get<double>());
    EXPECT_GT(p["interval_95"][1].get<double>(), p["value"].get<double>());
    // The table of candidates is in the sensors' convention, too: of the same sign.
    const auto line = std::ranges::find_if(
        d["candidates"], [](const auto& c) { return c["label"] == "torquer_asymmetry.y"; });
    ASSERT_NE(line, d["candidates"].end());
    EXPECT_NEAR((*line)["amplitude"].get<double>(), p["value"].get<double>(),
                4.0 * (*line)["sigma"].get<double>());
  }
}

/// A drift of nine prior sigmas beside an effect: the next fit needs the room that this one had.
TEST(DeclaredNoise, RoomInAPriorThatIsAnnouncedStandsInThePatchedStudy) {
  const test::ScratchFolder scratch;
  const std::string study =
      scratch.write("study.toml", test::strapdown_study("34.3775 deg", "9.8 m/s^2"));
  Theta sensors = strapdown::case_unit::sensors();
  test::set(sensors, "s_a_y", 8.0);
  test::set(sensors, "D_F_z", 9.0);
  write_recording(strapdown_recording(strapdown::case_unit::script(22), sensors),
                  scratch.file("unit.csv"));
  const test::Answer a = test::driftscope("diagnose " + study + " " + scratch.file("unit.csv") +
                                          " -o " + scratch.file("out"));
  ASSERT_EQ(a.code, 0) << a.err;
  ASSERT_NE(a.out.find("in the prior of D_F_z."), std::string::npos) << a.out;
  const mc::Study patched = mc::read_study(scratch.file("out") + "/patched.toml");
  EXPECT_NEAR(patched.filters.front().priors[TermLibrary::index("D_F_z")].sigma(),
              9.0 * unit::deg_per_h.to_si, 0.5 * unit::deg_per_h.to_si);
}

}  // namespace
}  // namespace drift::declared_noise_test
