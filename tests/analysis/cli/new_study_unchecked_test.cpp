// What `driftscope new` makes of a log as laboratories write them, and what of it is still to be
// checked.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <utility>

#include "tests/support/log_edits.hpp"
#include "tests/support/program.hpp"
#include "tests/support/short_study.hpp"

namespace drift::new_study_unchecked_test {
namespace {

using namespace drift::test;

TEST(NewStudy, RestsThatAreTooShortForACardShowTheNoiseToo) {
  const ScratchFolder folder;
  // Twelve rows a position: 5 are taken by the polynomial, 6 x 3 x 7 free numbers, of whose
  // variances the median is taken: 1 sigma of it is 1.25 sqrt(2 / 7 / 18) / 2 = 8 % of sigma.
  const std::string made = folder.write("made.toml", replaced(short_study, "10 min", "12 min")),
                    own = folder.file("own.csv"), file = folder.file("lab.toml");
  ASSERT_EQ(driftscope("simulate " + made + " -o " + own +
                       " --set 'readout.accelerometer_noise=\"250 ug\"' --set "
                       "'readout.gimbal_noise=\"45 arcsec\"' --set 'plan.sample=\"60 s\"'")
                .code,
            0);
  ASSERT_EQ(driftscope("new diagnose " + own + " -o " + file).code, 0);
  const std::string study = text_of(file);
  const auto number_after = [&](const std::string& key) {
    const auto at = study.find(key + " ");
    return at == std::string::npos ? 0.0 : std::stod(study.substr(study.find('"', at) + 1));
  };
  EXPECT_NEAR(number_after("accelerometer_noise"), 250.0, 4.0 * 0.08 * 250.0) << study;
  EXPECT_NEAR(number_after("gimbal_noise"), 45.0, 4.0 * 0.08 * 45.0) << study;
  EXPECT_TRUE(has(driftscope("look " + own).out, "samples scatter about their slow course"));
}

/// The attitudes and headings of the plan in a study file.
std::string plan_of(const std::string& study) {
  std::istringstream lines(study);
  std::string out;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("axes ") || line.starts_with("case_heading ")) out += line + "\n";
  return out;
}

TEST(NewStudy, ANumberThatChangesARowLateLeavesThePlanAsItWas) {
  const ScratchFolder folder;
  const std::string made = folder.write("made.toml", short_study), own = folder.file("own.csv");
  ASSERT_EQ(driftscope("simulate " + made + " -o " + own).code, 0);
  const std::string late = folder.write(
      "late.csv", with_column(text_of(own), "position",
                              [before = std::string()](const std::string& cell) mutable {
                                std::string was = std::exchange(before, cell);
                                return was.empty() ? cell : was;
                              }));
  ASSERT_EQ(driftscope("new diagnose " + own + " -o " + folder.file("right.toml")).code, 0);
  ASSERT_EQ(driftscope("new diagnose " + late + " -o " + folder.file("late.toml")).code, 0);
  const std::string right = plan_of(text_of(folder.file("right.toml")));
  EXPECT_TRUE(has(right, "case_heading = \"45 deg\"")) << right;
  EXPECT_EQ(plan_of(text_of(folder.file("late.toml"))), right);
}

/// The short names that a laboratory has for gimbals, the clock as its instrument writes it.
std::string as_logged(std::string text) {
  for (const auto& [from, to] : {std::pair{"gimbal_outer [deg]", "Outer [deg]"},
                                 {"gimbal_middle [deg]", "Mid [deg]"},
                                 {"gimbal_inner [deg]", "Inner [deg]"},
                                 {"acc_x [g]", "Ax [m/s^2]"},
                                 {"acc_y [g]", "Ay [m/s^2]"},
                                 {"acc_z [g]", "Az [m/s^2]"}})
    text = replaced(std::move(text), from, to);
  for (const char* axis : {"Ax [m/s^2]", "Ay [m/s^2]", "Az [m/s^2]"})
    text = with_column(text, axis, [](const std::string& cell) {
      return fmt::format("{:.9f}", 9.8 * std::stod(cell));
    });
  text = with_column(text, "time [s]", [](const std::string& cell) {
    const int t = static_cast<int>(std::lround(std::stod(cell)));
    return fmt::format("03/14/2026 {:02}:{:02}:{:02}", 8 + t / 3600, t / 60 % 60, t % 60);
  });
  return replaced(std::move(text), "time [s]", "Clock");
}

TEST(NewStudy, TheThirdGimbalMayHaveAShortNameAndAClockWritesTheMonthFirst) {
  const ScratchFolder folder;
  const std::string made = folder.write("made.toml", short_study), own = folder.file("own.csv"),
                    file = folder.file("lab.toml");
  ASSERT_EQ(driftscope("simulate " + made + " -o " + own).code, 0);
  folder.write("own.csv", as_logged(text_of(own)));
  const Answer made_new = driftscope("new diagnose " + own + " -o " + file);
  ASSERT_EQ(made_new.code, 0) << made_new.err;
  const std::string study = text_of(file);
  EXPECT_TRUE(has(study, "gimbal_middle = \"Mid [deg]\"")) << study;
  EXPECT_TRUE(has(study, "time = \"Clock\"")) << study;
  const Answer fit = driftscope("identify " + file + " " + own + " --quiet");
  EXPECT_EQ(fit.code, 0) << fit.err;
}

TEST(NewStudy, GravityOfALogOfSensorsOnACaseIsToBeCheckedWhereItDividesIt) {
  const ScratchFolder folder;
  for (const auto& [unit, up, check] :
       {std::tuple{"m/s^2", 9.81, true}, std::tuple{"g", 1.0, false}}) {
    std::string text = fmt::format(
        "time [s],gyro_x [rad/s],gyro_y [rad/s],gyro_z [rad/s],acc_x [{0}],acc_y [{0}],acc_z "
        "[{0}]\n",
        unit);
    for (int row = 1; row <= 300; ++row)
      text += fmt::format("{:.2f},{:.4f},0.002,0.003,0.1,0.2,{:.4f}\n", 0.01 * row,
                          1e-4 * (row % 7), up + 1e-3 * (row % 5));
    const std::string log = folder.write(check ? "ms2.csv" : "g.csv", text),
                      file = folder.file(check ? "ms2.toml" : "g.toml");
    const Answer made = driftscope("new strapdown " + log + " -o " + file);
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_EQ(has(text_of(file), "# there: check; a recording in m/s^2"), check) << text_of(file);
    EXPECT_TRUE(has(text_of(file), "a recording in m/s^2 is divided by it")) << text_of(file);
    EXPECT_EQ(driftscope("check " + file).code, 0);
  }
}

TEST(NewStudy, WhatNobodyHasCheckedIsNoFactOfWhatIsConverted) {
  const ScratchFolder folder;
  const std::string made = folder.write("made.toml", short_study), own = folder.file("own.csv"),
                    file = folder.file("lab.toml"), read = folder.file("read.csv");
  ASSERT_EQ(driftscope("simulate " + made + " -o " + own).code, 0);
  folder.write("own.csv", as_logged(text_of(own)));
  ASSERT_EQ(driftscope("new diagnose " + own + " -o " + file).code, 0);
  EXPECT_TRUE(has(text_of(file), "# there: check; a recording in m/s^2")) << text_of(file);
  const Answer converted = driftscope("convert " + file + " " + own + " -o " + read);
  ASSERT_EQ(converted.code, 0) << converted.err;
  EXPECT_TRUE(has(converted.err, "nobody has checked yet")) << converted.err;
  EXPECT_FALSE(has(text_of(read), "# latitude")) << text_of(read).substr(0, 500);
  EXPECT_TRUE(has(text_of(read), "# gravity = 9.80665"));
  const std::string again = folder.file("again.toml");
  ASSERT_EQ(driftscope("new diagnose " + read + " -o " + again).code, 0);
  EXPECT_TRUE(has(text_of(again), "# of the laboratory: check")) << text_of(again);
  // 9.8 for 9.80665 m/s^2 are 678 ppm, which no longer can be set right in the study.
  const Answer other =
      driftscope("identify " + again + " " + read + " --set 'site.gravity=\"9.8 m/s^2\"'");
  EXPECT_TRUE(has(other.err, "K1 is off by -678 ppm")) << other.err;
  // A log that was not converted is divided by the study's, whatever it says.
  folder.write("own.csv", "# gravity = 9.80665 m/s^2\n" + text_of(own));
  const Answer direct =
      driftscope("identify " + file + " " + own + " --set 'site.gravity=\"9.8 m/s^2\"'");
  EXPECT_EQ(direct.code, 0) << direct.err;
  EXPECT_FALSE(has(direct.err, "K1 is off by")) << direct.err;
}

TEST(NewStudy, ALogOfWhichNoStudyCanBeMadeIsWhatIsWrong) {
  const ScratchFolder folder;
  const std::string made = folder.write("made.toml", short_study), own = folder.file("own.csv"),
                    file = folder.file("lab.toml");
  ASSERT_EQ(driftscope("simulate " + made + " -o " + own).code, 0);
  // Turns of 90 deg and more within a position are no noise of resolvers.
  folder.write("own.csv", with_column(text_of(own), "position", [](const std::string& cell) {
                 return std::string(std::stoi(cell) <= 3 ? "1" : "2");
               }));
  const Answer a = driftscope("new diagnose " + own + " -o " + file);
  EXPECT_EQ(a.code, 4) << a.err;
  EXPECT_TRUE(has(a.err, own + ": the study that is made of it cannot be read")) << a.err;
  EXPECT_TRUE(has(a.err, "'readout.gimbal_noise'")) << a.err;
  EXPECT_FALSE(has(a.err, file)) << a.err;
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(NewStudy, NoiseBelowTheLeastOfAStudyIsTheLeast) {
  const ScratchFolder folder;
  for (const std::string dwell : {"10 min", "20 min"}) {  // by their scatter; by a noise card
    const std::string made = folder.write("made.toml", replaced(short_study, "10 min", dwell)),
                      own = folder.file(dwell.substr(0, 2) + ".csv"),
                      file = folder.file(dwell.substr(0, 2) + ".toml");
    ASSERT_EQ(driftscope("simulate " + made + " -o " + own +
                         " --set 'readout.accelerometer_noise=\"0.001 ug\"' --set "
                         "'readout.gimbal_noise=\"0.001 arcsec\"'")
                  .code,
              0);
    const Answer a = driftscope("new diagnose " + own + " -o " + file);
    ASSERT_EQ(a.code, 0) << a.err;
    EXPECT_TRUE(has(text_of(file), "accelerometer_noise = \"0.001 ug\"")) << text_of(file);
    EXPECT_TRUE(has(text_of(file), "gimbal_noise        = \"0.001 arcsec\"")) << text_of(file);
  }
}

}  // namespace
}  // namespace drift::new_study_unchecked_test
