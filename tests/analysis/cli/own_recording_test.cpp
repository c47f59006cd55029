#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.hpp"
#include "core/recording/recording.hpp"
#include "tests/support/lab_file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/strapdown_recording.hpp"

namespace drift::own_recording_test {
namespace {

using test::driftscope, test::LabColumn, test::LabFile, test::ScratchFolder;

const std::string study_text = R"toml(schema = 1
[site]
latitude = "45.75 deg"
gravity = "9.81 m/s^2"
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

/// A simulated recording, and the file that a laboratory would have of it.
struct Own {
  ScratchFolder folder;
  std::string study = folder.write("study.toml", study_text);
  std::string made = folder.file("made.csv");
  LabFile lab;
  Recording truth;

  Own() {
    const auto answer = driftscope("simulate '" + study + "' -o '" + made + "'");
    EXPECT_EQ(answer.code, 0) << answer.err;
    truth = read_recording(made, RecordingKind::platform, 9.81);
    for (LabColumn& c : lab.columns) {
      c.sign = 1.0;
      c.offset = 0.0;
    }
    lab.units = LabFile::Units::row;
    lab.preamble = {"Messung 7", "Pruefer Meier"};
  }
};

void expect_same_numbers(const LabFile& lab, const Recording& got, const Recording& truth) {
  ASSERT_EQ(got.rows(), truth.rows());
  for (const LabColumn& c : lab.columns) {
    ASSERT_NE(got.find(c.channel), nullptr) << c.channel;
    for (std::size_t i = 0; i < got.rows(); ++i)
      ASSERT_NEAR(got.find(c.channel)->values[i], truth.find(c.channel)->values[i], c.rounding())
          << c.channel << " in row " << i;
  }
}

TEST(OwnRecording, WhatLookProposesReadsTheFile) {
  Own own;
  const std::string log = own.folder.write("log.txt", own.lab.text(own.truth));
  const auto look = driftscope("look '" + log + "'");
  EXPECT_EQ(look.code, 0) << look.err;
  const auto begin = look.out.find("[recording]");
  ASSERT_NE(begin, std::string::npos) << look.out;
  EXPECT_NE(look.out.find("driftscope diagnose"), std::string::npos) << look.out;
  const std::string section = look.out.substr(begin, look.out.find("\n\n", begin) - begin);
  EXPECT_NE(section.find("acc_x = \"Ax [m/s^2]\""), std::string::npos) << section;
  EXPECT_NE(section.find("\"Lage 6\" = 6"), std::string::npos) << section;
  const std::string study = own.folder.write("lab.toml", study_text + section + "\n");
  for (const char* name : {"out.csv", "out.h5", "out.mat"}) {
    const std::string out = own.folder.file(name);
    const auto convert = driftscope("convert '" + study + "' '" + log + "' -o '" + out + "'");
    EXPECT_EQ(convert.code, 0) << convert.err;
    expect_same_numbers(own.lab, read_recording(out, RecordingKind::platform, 9.81), own.truth);
  }
  const auto checked = driftscope("check '" + study + "'");
  EXPECT_NE(checked.out.find("recording.columns.acc_x"), std::string::npos) << checked.out;
  const auto with_study = driftscope("look '" + log + "' '" + study + "'");
  EXPECT_EQ(with_study.code, 0) << with_study.err;
  EXPECT_NE(with_study.out.find("(1 at rest)"), std::string::npos) << with_study.out;
}

TEST(OwnRecording, IdentifyReadsTheFileAsItIs) {
  Own own;
  const std::string log = own.folder.write("log.csv", own.lab.text(own.truth));
  const std::string study = own.folder.write(
      "lab.toml", study_text + own.lab.section().replace(
                                   own.lab.section().find("positions"), std::string::npos,
                                   "positions = { \"Lage 1\" = 1, \"Lage 2\" = 2, \"Lage 3\" = 3, "
                                   "\"Lage 4\" = 4, \"Lage 5\" = 5, \"Lage 6\" = 6 }\n"));
  const auto answer = driftscope("identify '" + study + "' '" + log + "' --full --progress none");
  EXPECT_EQ(answer.code, 0) << answer.err;
  EXPECT_NE(answer.out.find("columns of text are passed over"), std::string::npos) << answer.out;
  EXPECT_EQ(answer.err.find("site.gravity"), std::string::npos) << answer.err;
  std::string without = test::text_of(study);
  without.erase(without.find("gravity ="), std::string("gravity = \"9.81 m/s^2\"\n").size());
  const auto assumed =
      driftscope("identify '" + own.folder.write("no.toml", without) + "' '" + log + "'");
  EXPECT_NE(assumed.err.find("divided by site.gravity, which is not given"), std::string::npos)
      << assumed.err;
}

TEST(OwnRecording, AnotherUnitOfTimeIsAskedAbout) {
  Own own;
  for (const char* unit : {"time [ms]", "time [min]"}) {
    std::string text = test::text_of(own.made);
    text.replace(text.find("time [s]"), 8, unit);
    const std::string log = own.folder.write("log.csv", text);
    const auto answer = driftscope("identify '" + own.study + "' '" + log + "' --progress none");
    EXPECT_EQ(answer.code, 4) << answer.out;
    EXPECT_NE(answer.err.find("Correct the unit of time"), std::string::npos) << answer.err;
  }
}

TEST(OwnRecording, AFileOfUnknownNamesIsOneMessage) {
  Own own;
  const std::string log = own.folder.write("log.csv", own.lab.text(own.truth));
  const auto answer = driftscope("diagnose '" + own.study + "' '" + log + "'");
  EXPECT_EQ(answer.code, 4);
  EXPECT_EQ(std::ranges::count(answer.err, '\n'), 1) << answer.err;
  EXPECT_NE(answer.err.find("driftscope look"), std::string::npos) << answer.err;
}

TEST(OwnRecording, ConvertReplacesOnlyWhatItMade) {
  Own own;
  const std::string kept = own.folder.write("kept.csv", "mine");
  const auto refused =
      driftscope("convert '" + own.study + "' '" + own.made + "' -o '" + kept + "'");
  EXPECT_EQ(refused.code, 7) << refused.err;
  EXPECT_EQ(test::text_of(kept), "mine");
  const std::string out = own.folder.file("out.csv");
  for (int i = 0; i < 2; ++i)
    EXPECT_EQ(driftscope("convert '" + own.study + "' '" + own.made + "' -o '" + out + "'").code,
              0);
  EXPECT_EQ(driftscope("convert '" + own.study + "' '" + own.made + "' -o '" + own.made + "'").code,
            2);
}

TEST(OwnRecording, LookSaysWhatIsMissingOfWhatCannotBeRead) {
  const ScratchFolder folder;
  const std::string log = folder.write("log.dat", "alpha beta\n1 2\n3 4\n");
  const auto look = driftscope("look '" + log + "'");
  EXPECT_EQ(look.code, 0) << look.err;
  EXPECT_NE(look.out.find("It is not a recording yet"), std::string::npos) << look.out;
  EXPECT_EQ(driftscope("look '" + folder.file("none.csv") + "'").code, 6);
}

TEST(OwnRecording, TheNoiseThatLookProposesIsThatOfTheSensorsAndAStudyReadsIt) {
  const ScratchFolder folder;
  const test::StrapdownScript script{.dwells = 8, .rest = 10.0, .acc_noise = 0.0015};
  const std::string log = folder.file("log.csv");
  write_recording(test::strapdown_recording(script, Theta::Zero()), log);
  const auto look = driftscope("look '" + log + "'");
  EXPECT_EQ(look.code, 0) << look.err;
  EXPECT_NE(look.out.find("Noise of the gyros at rest"), std::string::npos) << look.out;
  const auto begin = look.out.find("[readout]");
  ASSERT_NE(begin, std::string::npos) << look.out;
  const std::string study = folder.write(
      "lab.toml", study_text + look.out.substr(begin, look.out.find("\n\n", begin) - begin));
  const auto checked = driftscope("check '" + study + "'");
  EXPECT_EQ(checked.code, 0) << checked.err;
  // 24,000 samples tell 1500 ug to half a percent: four sigmas are 30 ug.
  const auto key = look.out.find("accelerometer_noise = \"", begin);
  EXPECT_NEAR(std::stod(look.out.substr(key + 23)), 1500.0, 30.0) << look.out.substr(begin, 200);
}

TEST(OwnRecording, VersionIsAnOptionToo) {
  const auto answer = driftscope("--version");
  EXPECT_EQ(answer.code, 0);
  EXPECT_TRUE(answer.out.starts_with("driftscope ")) << answer.out;
}

/// A log of the plan twentyfour with names that say nothing of what the columns hold.
struct Nameless {
  ScratchFolder folder;
  std::string study, made, log;

  explicit Nameless(const std::string& unit_row = ";;m/s^2;m/s^2;m/s^2;deg;deg;deg;rad") {
    std::string text = study_text;
    text.replace(text.find("\"six\""), 5, "\"twentyfour\"");
    study = folder.write("study.toml", text);
    made = folder.file("made.csv");
    EXPECT_EQ(driftscope("simulate '" + study + "' -o '" + made + "'").code, 0);
    const Recording r = read_recording(made, RecordingKind::platform, 9.81);
    std::string out =
        "Zeit_s;Lage;Kanal 1;Kanal 2;Kanal 3;Rahmen_A;Rahmen_M;Rahmen_I;Sockel\n" + unit_row + "\n";
    const auto at = [&](const char* name, std::size_t row) { return r.find(name)->values[row]; };
    for (std::size_t i = 0; i < r.rows(); ++i)
      out += fmt::format("{};{};{:.9f};{:.9f};{:.9f};{:.9f};{:.9f};{:.9f};{:.6f}\n", at("time", i),
                         at("position", i), 9.81 * at("acc_x", i), 9.81 * at("acc_y", i),
                         9.81 * at("acc_z", i), at("gimbal_outer", i) / detail::deg,
                         at("gimbal_middle", i) / detail::deg, at("gimbal_inner", i) / detail::deg,
                         at("case_heading", i));
    log = folder.write("log.csv", out);
  }
  static std::string section(const std::string& out) {
    const auto begin = out.find("[recording]");
    return begin == std::string::npos ? "" : out.substr(begin, out.find("\n\n", begin) - begin);
  }
};

TEST(OwnRecording, LookTellsAccelerometersAndTheHeadingOfTheCaseByTheirValues) {
  for (const std::string units :
       {";;m/s^2;m/s^2;m/s^2;deg;deg;deg;rad", "s;-;-;-;-;deg;deg;deg;rad"}) {
    const Nameless own(units);
    const auto look = driftscope("look '" + own.log + "'");
    EXPECT_EQ(look.code, 0) << look.err;
    const std::string section = Nameless::section(look.out);
    EXPECT_NE(section.find("acc_x = \"Kanal 1 [m/s^2]\", acc_y = \"Kanal 2 [m/s^2]\", acc_z = "
                           "\"Kanal 3 [m/s^2]\""),
              std::string::npos)
        << look.out;
    EXPECT_NE(section.find("case_heading = \"Sockel [rad]\""), std::string::npos) << look.out;
    EXPECT_NE(section.find("in the order of the columns: check"), std::string::npos) << section;
    EXPECT_EQ(look.out.find("No column seems to be"), std::string::npos) << look.out;
    std::string text = test::text_of(own.study);
    const std::string study = own.folder.write("lab.toml", text + section + "\n");
    const auto answer = driftscope("identify '" + study + "' '" + own.log + "' --progress none");
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_EQ(answer.out.find("Misfit"), std::string::npos) << answer.out;
  }
}

TEST(OwnRecording, NewReadsWhatLookTellsByValues) {
  const Nameless own;
  const std::string study = own.folder.file("new.toml");
  const auto made = driftscope("new diagnose '" + own.log + "' -o '" + study + "'");
  EXPECT_EQ(made.code, 0) << made.err;
  const std::string text = test::text_of(study);
  EXPECT_NE(text.find("case_heading = \"45 deg\""), std::string::npos) << text;
  EXPECT_EQ(text.find("=NW"), std::string::npos) << text;
  EXPECT_EQ(driftscope("identify '" + study + "' '" + own.log + "' --quiet").code, 0);
}

TEST(OwnRecording, LookNamesWhatNoColumnSeemsToBe) {
  const ScratchFolder folder;
  std::string rows = "time [s],position,rad_1 [rad],rad_2 [rad],rad_3 [rad]\n";
  for (int i = 0; i < 6; ++i) rows += fmt::format("{},1,0.{},0.2,0.3\n", 60 * (i + 1), i);
  const auto look = driftscope("look '" + folder.write("log.csv", rows) + "'");
  EXPECT_NE(look.out.find("No column seems to be accelerometers or gimbal angles"),
            std::string::npos)
      << look.out;
  EXPECT_NE(look.out.find("acc_x = "), std::string::npos) << look.out;
}

TEST(OwnRecording, ColumnsThatOnlyLookLikeAccelerometersAreNotTakenForThem) {
  const ScratchFolder folder;  // of three flags one is 1; a field of constant length has its unit
  std::string rows =
      "time [s],position,a_on,b_on,c_on,B1 [uT],B2 [uT],B3 [uT],gimbal_outer [deg],gimbal_middle "
      "[deg],gimbal_inner [deg],Breite [deg]\n";
  for (int i = 0; i < 30; ++i)
    rows += fmt::format("{},{},{},{},{},{:.4f},{:.4f},0.01,{},1,2,47.37\n", 60 * (i + 1),
                        1 + i / 10, i / 10 == 0 ? 1 : 0, i / 10 == 1 ? 1 : 0, i / 10 == 2 ? 1 : 0,
                        std::sin(i), std::cos(i), 0.25 * i);
  const auto look = driftscope("look '" + folder.write("log.csv", rows) + "'");
  EXPECT_EQ(look.out.find("acc_x ["), std::string::npos) << look.out;
  EXPECT_EQ(look.out.find("case_heading ["), std::string::npos) << look.out;
}

TEST(OwnRecording, LookCountsTheIntervalOfTheFirstRowAndSaysWhatItsColumnsMean) {
  const ScratchFolder folder;
  const std::string study = folder.write("study.toml", study_text), made = folder.file("made.csv");
  ASSERT_EQ(driftscope("simulate '" + study + "' -o '" + made + "'").code, 0);
  const auto look = driftscope("look '" + made + "'");
  EXPECT_NE(look.out.find("           20           240          240           20\n"),
            std::string::npos)
      << look.out;
  EXPECT_NE(look.out.find("stuck: samples in the longest run of one value"), std::string::npos);
}

TEST(OwnRecording, IdentifySaysFirstThatThereAreNoAccelerometers) {
  const Own own;
  Recording r = own.truth;
  std::erase_if(r.channels, [](const Channel& c) { return c.name.starts_with("acc_"); });
  const std::string log = own.folder.file("angles.csv"), out = own.folder.file("out");
  write_recording(r, log);
  const auto answer =
      driftscope("identify '" + own.study + "' '" + log + "' -o '" + out + "' --progress none");
  EXPECT_EQ(answer.code, 0) << answer.err;
  const std::string words =
      "gimbal angles alone: the recording has no accelerometers (acc_x, acc_y, acc_z)";
  std::string first = answer.out.substr(0, answer.out.find(';'));
  for (std::size_t at = 0; (at = first.find("\n  ", at)) != std::string::npos;)
    first.replace(at, 3, " ");
  EXPECT_NE(first.find(words), std::string::npos) << answer.out;
  EXPECT_NE(test::text_of(out + "/report.html").find(words), std::string::npos);
  EXPECT_NE(test::text_of(out + "/identification.json").find("\"absent_channels\""),
            std::string::npos);
}

}  // namespace
}  // namespace drift::own_recording_test
