// Axes of a sweep that change nothing.
#include "mc/study/idle_axes.hpp"

#include <gtest/gtest.h>

#include "mc/study/run_inputs.hpp"
#include "mc/study/sweep.hpp"
#include "tests/mc/small_study.hpp"
#include "tests/mc/study/listed_study.hpp"
#include "tests/mc/study/study_file.hpp"

namespace drift::idle_axes_test {
namespace {

using test::listed_study;
using test::mistakes;
using test::read_text;
using test::small_study;

std::vector<std::string> swept(const std::string& lines, const mc::Overrides& set = {},
                               const std::string& text = listed_study) {
  return mistakes(text + "[sweep]\n" + lines, set);
}
const std::string etas = "\"truth.parameters.eta\" = [\"0 arcsec\", \"50 arcsec\"]\n";

void expect_told(const std::string& line, const std::string& why, const std::string& what_to_do) {
  const auto found = swept(line);
  ASSERT_EQ(found.size(), 1u) << line;
  EXPECT_EQ(found[0].find("study.toml:32:1: 'sweep.\""), 0u) << found[0];
  EXPECT_NE(found[0].find("\"' changes nothing: " + why + " (expected "), std::string::npos)
      << found[0];
  EXPECT_TRUE(found[0].ends_with(". " + what_to_do)) << found[0];
}

TEST(IdleAxes, AreRefusedWithTheReasonThatTheFileShows) {
  expect_told(etas, "eta_x, eta_y and eta_z have values of their own",
              "Name them instead, or remove their values");
  expect_told("\"plan.dwell\" = [\"10 min\", \"20 min\"]\n",
              "every position has a dwell of its own",
              "Name that of a position (plan.position.0.dwell), or remove it from the positions");
  expect_told("\"plan.mode\" = [\"free\", \"level\"]\n", "every position has a mode of its own",
              "Name that of a position (plan.position.0.mode), or remove it from the positions");
  expect_told("\"readout.gimbal_noise\" = [\"5 arcsec\", \"10 arcsec\"]\n", "gimbals are not read",
              "Set readout.gimbals = true, or leave out what is of them");
  expect_told("\"plan.slew_rate\" = [\"0.1 deg/s\", \"1 deg/s\"]\n",
              "no position is entered torqued, and caged ones are entered without a way",
              "Let a position have entry = \"torqued\", or leave it out");
  expect_told("\"site.gravity\" = [\"9.80 m/s^2\", \"9.82 m/s^2\"]\n",
              "runs are simulated in local g, gravity is for recordings in m/s^2",
              "Remove the line");
}

TEST(IdleAxes, AreRefusedWhereNoReasonIsKnown) {
  for (const char* line :
       {"\"title\" = [\"a\", \"b\"]\n", "\"filter.f5.name\" = [\"a\", \"b\"]\n",
        "\"mounting.accelerometer_x\" = [\"x y z\", \"x -z y\"]\n",
        "\"environment.temperature\" = [\"20 degC\", \"30 degC\"]\n",
        "\"plan.position.second.axes\" = [\"x=U y=S z=E\", \"z=E x=U y=S\"]\n",
        "readout = [{ gimbal_noise = \"5 arcsec\" }, { gimbal_noise = \"9 arcsec\" }]\n"}) {
    const auto found = swept(line);
    ASSERT_EQ(found.size(), 1u) << line;
    EXPECT_NE(found[0].find("' changes nothing: "), std::string::npos) << found[0];
  }
}

TEST(IdleAxes, AreToldAllAtOnceAndWhereTheCommandLineHasThem) {
  EXPECT_EQ(swept(etas + "\"plan.mode\" = [\"free\", \"level\"]\n" +
                  "\"plan.position.0.mode\" = [\"free\", \"level\"]\n")
                .size(),
            2u);
  const auto set = mistakes(listed_study, {{"sweep.\"plan.dwell\"", "[\"10 min\", \"20 min\"]"}});
  ASSERT_EQ(set.size(), 1u);
  EXPECT_EQ(set[0].find("--set sweep.\"plan.dwell\": 'sweep.\"plan.dwell\"' changes nothing"), 0u)
      << set[0];
}

TEST(IdleAxes, ThatChangeSomethingSomewhereAreNone) {
  EXPECT_TRUE(swept("\"plan.position.second.dwell\" = [\"30 min\", \"40 min\"]\n").empty());
  // Two of three values are one study; a single value is told as it is.
  EXPECT_TRUE(swept("readout = [{ gimbal_noise = \"5 arcsec\" }, { gimbal_noise = \"9 arcsec\" }, "
                    "{ accelerometer_noise = \"9 ug\" }]\n")
                  .empty());
  EXPECT_TRUE(swept("\"plan.dwell\" = [\"10 min\"]\n").empty());
  // One value of another axis is enough: the last that is tried.
  EXPECT_TRUE(swept("\"readout.gimbal_noise\" = [\"5 arcsec\", \"10 arcsec\"]\n"
                    "\"readout.gimbals\" = [false, true]\n")
                  .empty());
  EXPECT_TRUE(swept("\"truth.coupling\" = [\"eq5\", \"servo\"]\n"
                    "\"truth.servo.lead\" = [\"30 ms\", \"40 ms\"]\n")
                  .empty());
  EXPECT_TRUE(swept(etas, {{"truth.parameters", "{ eta_x = \"1 arcsec\" }"}}).empty());
  EXPECT_TRUE(swept("\"plan.slew_rate\" = [\"0.1 deg/s\", \"1 deg/s\"]\n",
                    {{"plan.position.1.entry", "torqued"}})
                  .empty());
  EXPECT_TRUE(swept("\"mounting.gyro_x\" = [\"x y z\", \"x -z y\"]\n").empty());
}

TEST(IdleAxes, OfAStudyWithoutRunsAreNotLookedFor) {
  std::string recorded = listed_study;
  recorded.erase(recorded.find("[truth]"), recorded.find("[[filter]]") - recorded.find("[truth]"));
  EXPECT_TRUE(swept("\"plan.dwell\" = [\"10 min\", \"20 min\"]\n", {}, recorded).empty());
}

TEST(IdleAxes, OfResultsThatAreThereAreTaken) {
  const std::string text = listed_study + "[sweep]\n" + etas;
  EXPECT_THROW(mc::read_study_text(text, "study.toml"), InputError);
  const mc::Study study = mc::read_study_text(text, "study.toml", {}, mc::IdleAxes::taken);
  EXPECT_EQ(mc::study_points(study).size(), 2u);
}

TEST(RunInputs, AreEqualWhereTheSameIsSaidInOtherWords) {
  const auto inputs = [](const mc::Overrides& set) {
    return mc::run_inputs(read_text(small_study, set));
  };
  const std::string base = inputs({});
  EXPECT_EQ(inputs({{"plan.dwell", "1200 s"}}), base);
  EXPECT_EQ(inputs({{"title", "Other"}}), base);
  EXPECT_EQ(inputs({{"monte_carlo.runs", "7"}}), base);
  for (const mc::Overrides& set : std::vector<mc::Overrides>{
           {{"plan.dwell", "22 min"}},
           {{"plan.sample", "1 min"}},
           {{"plan.mode", "level"}},
           {{"plan.preset", "twelve"}},
           {{"site.latitude", "45.7501 deg"}},
           {{"readout.gimbal_noise", "5.001 arcsec"}},
           {{"readout.gimbals", "false"}},
           {{"truth.coupling", "eq6"}},
           {{"truth.terms", "[\"fixed_drift\"]"}},
           {{"truth.parameters.D_I_x", "1 deg/h/g"}},
           {{"truth.initial_attitude", "1 arcsec"}},
           {{"truth.angle_random_walk", "0.001 deg/sqrt(h)"}},
           {{"filter.right.parameters.D_I_x", "{ normal = [\"0 deg/h/g\", \"1 deg/h/g\"] }"}},
           {{"filter.right.starts", "3"}},
           {{"filter.right.starts", "[{ D_I_x = \"1 deg/h/g\" }, {}]"}},
           {{"filter.wrong.drift_random_walk", "0.001 deg/h/sqrt(h)"}},
           {{"mounting.accelerometer_x", "x -z y"}},
           {{"monte_carlo.design", "sobol"}},
           {{"monte_carlo.estimator", "ekf"}}})
    EXPECT_NE(inputs(set), base) << set.front().first;
}

}  // namespace
}  // namespace drift::idle_axes_test
