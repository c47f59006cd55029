// Mistakes of the command line: what is said of them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/program.hpp"
#include "tests/support/short_study.hpp"

namespace drift::arguments_test {
namespace {

using namespace drift::test;

std::string refusal(const std::string& arguments) {
  const Answer answer = test::run_program(DRIFT_SYNTHETIC, arguments);
  EXPECT_EQ(answer.code, 2) << arguments << ": " << answer.err;
  return answer.err;
}

void expect_says(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "expected: " << part << "\nin: " << text;
}

TEST(Arguments, NumbersOutOfRangeNameTheRange) {
  for (const char* runs : {"0", "-1", "1e3", "99999999999999999999999", "many"})
    expect_says(refusal("run x.toml --runs " + std::string(runs)),
                "(expected a whole number from 1 to 1000000000)");
  for (const char* seed : {"-1", "0x", "18446744073709551616", "1.5"})
    expect_says(refusal("run x.toml --seed " + std::string(seed)),
                "(expected a whole number from 0 to 2^64-1, decimal or as \"0x...\")");
  expect_says(refusal("simulate x.toml -o x.csv --run -1"),
              "(expected a whole number from 0 to 999999999)");
}

TEST(Arguments, TheLargestSeedIsTakenAsManifestsPrintIt) {
  const ScratchFolder folder;
  const std::string study = folder.write("s.toml", short_study);
  std::vector<std::string> made;
  for (const std::string seed : {"18446744073709551615", "0xffffffffffffffff", "1"}) {
    made.push_back(folder.file(seed + ".csv"));
    ASSERT_EQ(driftscope("simulate " + study + " --seed " + seed + " -o " + made.back()).code, 0);
  }
  const auto rows = [](const std::string& file) {
    const std::string text = text_of(file);
    return text.substr(text.find("time ["));
  };
  EXPECT_EQ(rows(made[0]), rows(made[1]));
  EXPECT_NE(rows(made[0]), rows(made[2]));
}

TEST(Arguments, UnknownCommandsAndOptionsGetTheNearestOne) {
  expect_says(refusal("runn x.toml"), "unknown command 'runn' (expected one of check, simulate, ");
  expect_says(refusal("runn x.toml"), "Did you mean 'run'?");
  expect_says(refusal("run x.toml --frobnicate"),
              "unknown option '--frobnicate' (expected one of ");
  expect_says(refusal("run x.toml --thread=2"), "unknown option '--thread' (expected one of ");
  expect_says(refusal("run x.toml --thread=2"), "Did you mean '--threads'?");
  expect_says(refusal("--versoin"), "unknown option '--versoin'");
}

TEST(Arguments, TheValueOfAnOptionBeforeTheCommandIsNoCommand) {
  const std::string threads = refusal("--threads 0 check x.toml");
  expect_says(threads, "--threads: ");
  expect_says(threads, "1 to 4096");
  expect_says(refusal("--color maybe check x.toml"), "--color: ");
  expect_says(refusal("--threads 1 chekc x.toml"), "unknown command 'chekc'");
  expect_says(refusal("--threads 1 chekc x.toml"), "Did you mean 'check'?");
}

TEST(Arguments, AnEmptyNameIsNoPlaceForResults) {
  for (const char* command :
       {"run x.toml -o ''", "simulate x.toml -o ''", "export x --format csv -o ''",
        "replay x --run 1 --trace ''", "identify x.toml -o ''", "rank x.toml -o ''",
        "blind x.toml -o ''", "diagnose x.toml r.csv -o ''"})
    expect_says(refusal(command), "the name is empty (expected a file or folder)");
}

TEST(Arguments, AVariableThatIsNotSetIsNotTheWholeStudyWithoutLimit) {
  for (const char* command : {"run x.toml --worker ''", "run x.toml --max-wall ''",
                              "blind x.toml --worker ''", "rank x.toml --max-wall ''"})
    expect_says(refusal(command), "the value is empty (expected one; a variable that is not set?)");
}

TEST(Arguments, HelpIsNoMistake) {
  for (const char* words : {"--help", "run --help"})
    EXPECT_EQ(test::run_program(DRIFT_SYNTHETIC, words).code, 0) << words;
}

TEST(Arguments, WhatIsLeftOutIsShownByAnExample) {
  const std::string said = refusal("diagnose lab.toml");
  expect_says(said, "recordings is required");
  expect_says(said, "Example: driftscope diagnose ");
}

TEST(Program, CheckSaysHowTheCaseIsTurned) {
  const ScratchFolder folder;  // position 7 of eighteen needs the case turned
  const Answer a = driftscope("check " + folder.write("s.toml", short_study) +
                              " --set plan.preset=eighteen --set plan.dwell='20 min'");
  ASSERT_EQ(a.code, 0) << a.err;
  expect_says(a.out, "  45 deg  ");
}

TEST(Arguments, TheCommandHelpIsTheOptionHelp) {
  const auto out = [](const char* words) {
    const Answer answer = test::run_program(DRIFT_SYNTHETIC, words);
    EXPECT_EQ(answer.code, 0) << words << answer.err;
    return answer.out;
  };
  EXPECT_EQ(out("help"), out("--help"));
  EXPECT_EQ(out("help run"), out("run --help"));
  expect_says(out("help run"), "--max-wall");
  expect_says(refusal("help runn"), "unknown command 'runn' (expected one of check, ");
  expect_says(refusal("help runn"), "Did you mean 'run'?");
}

TEST(Arguments, EveryCommandOfTheHelpHasHelp) {
  const std::string list = test::run_program(DRIFT_SYNTHETIC, "help").out;
  for (const char* command :
       {"check",    "simulate", "rank",   "terms",  "look",       "convert", "identify",
        "diagnose", "run",      "status", "verify", "replay",     "report",  "export",
        "blind",    "new",      "help",   "schema", "completion", "version"}) {
    expect_says(list, std::string("\n  ") + command + " ");
    const Answer own = test::run_program(DRIFT_SYNTHETIC, std::string("help ") + command);
    EXPECT_EQ(own.code, 0) << command;
    expect_says(own.out, "Example: ");
  }
}

TEST(Program, CheckSaysWhichGravityIsAssumed) {
  const ScratchFolder folder;
  const std::string with = folder.write("with.toml", short_study);
  const Answer assumed = driftscope("check " + with + " --set site.latitude='47 deg'");
  ASSERT_EQ(assumed.code, 0) << assumed.err;
  EXPECT_NE(assumed.err.find("site.gravity is not given: 9.80665 m/s^2 is assumed"),
            std::string::npos)
      << assumed.err;
  const Answer given = driftscope("check " + with + " --set site.gravity='9.81 m/s^2'");
  EXPECT_EQ(given.err.find("site.gravity"), std::string::npos) << given.err;
}

TEST(Program, AttitudesThatAreNotThePlansAreOneMessageInTheUsersNames) {
  const ScratchFolder folder;
  const std::string study = folder.write("s.toml", short_study), recording = folder.file("r.csv");
  ASSERT_EQ(driftscope("simulate " + study + " -o " + recording).code, 0);
  std::string text = text_of(recording);
  for (const auto& [from, to] : {std::pair{"acc_z", "Beschl_3"}, std::pair{"[deg]", "[rad]"}})
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += 5)
      text.replace(at, 5, to);
  const std::string own = folder.write("own.csv", text);
  const std::string mapped = folder.write(
      "m.toml", text_of(study) + "\n[recording]\ncolumns = { acc_z = \"-Beschl_3 [g]\" }\n");
  const Answer a = driftscope("identify " + mapped + " " + own);
  EXPECT_EQ(a.code, recording_error);
  std::size_t errors = 0;
  for (std::size_t at = 0; (at = a.err.find("error: ", at)) != std::string::npos; ++at) ++errors;
  EXPECT_EQ(errors, 2u) << a.err;
  EXPECT_NE(a.err.find("acc_z = \"Beschl_3 [g]\""), std::string::npos) << a.err;
  EXPECT_NE(a.err.find("look like [deg], not [rad]"), std::string::npos) << a.err;
  EXPECT_EQ(a.err.find("as in the header"), std::string::npos) << a.err;
}

TEST(Program, ATruthThatNothingCanBeSimulatedFromIsRefusedByEveryCommandThatReadsIt) {
  const ScratchFolder folder;
  std::string text = short_study;
  const std::size_t truth = text.find("[truth]"),
                    line = 2 + static_cast<std::size_t>(std::count(
                                   text.begin(), text.begin() + static_cast<std::ptrdiff_t>(truth),
                                   '\n'));
  text.insert(truth + 7, "\nterms = [\"fixed_drift\", \"magnetic_drift\"]");
  const std::string study = folder.write("s.toml", text);
  const std::string with_field =
      folder.write("f.toml", text +
                                 "\n[environment]\nfield_n = \"0.2 gauss\"\nfield_w = \"0 gauss\"\n"
                                 "field_u = \"-0.5 gauss\"\n");
  for (const std::string command : {"check ", "identify ", "run ", "simulate -o x.csv "}) {
    const Answer a = driftscope(command + study);
    EXPECT_EQ(a.code, config_error) << command << a.err;
    EXPECT_NE(a.err.find(fmt::format("s.toml:{}: [truth]: term 'magnetic_drift' needs the magnetic "
                                     "field",
                                     line)),
              std::string::npos)
        << command << a.err;
  }
  EXPECT_EQ(driftscope("check " + with_field).code, 0);
  // A filter may be meant for recordings that have the field.
  const std::string of_filter = folder.write("o.toml", short_study);
  EXPECT_EQ(driftscope("check " + of_filter +
                       " --set 'filter.corrected.terms=[\"fixed_drift\", \"magnetic_drift\"]'")
                .code,
            0);
}

TEST(Program, AWrongCommandLineIsAnErrorAndTheNearestNameIsAskedAbout) {
  for (const char* line : {"", "check", "identify --threads 0 x.toml", "new diagnse -o x.toml",
                           "export x --format foo", "identify x.toml --seed abc"})
    EXPECT_EQ(driftscope(line).err.find("error: "), 0u) << line << "\n" << driftscope(line).err;
  EXPECT_NE(driftscope("new diagnse -o x.toml").err.find("Did you mean 'diagnose'?"),
            std::string::npos);
  EXPECT_NE(driftscope("export x --format hdf6").err.find("Did you mean 'hdf5'?"),
            std::string::npos);
  EXPECT_NE(driftscope("help export").out.find("{hdf5,netcdf,csv,json}"), std::string::npos);
}

TEST(Program, AFolderThatIsNotThereIsNotOneWithoutResults) {
  const ScratchFolder folder;
  const std::string absent = folder.file("absent");
  for (const std::string command :
       {"verify ", "status ", "export --format csv ", "report ", "replay --run 1 "}) {
    const Answer a = driftscope(command + absent);
    EXPECT_EQ(a.code, store_error) << command;
    EXPECT_NE(a.err.find("absent: there is no such folder"), std::string::npos) << command << a.err;
    EXPECT_NE(driftscope(command + folder.path()).err.find("holds no results"), std::string::npos)
        << command;
  }
}

TEST(Program, WhatCannotBeAdvisedIsRefusedBeforeTheDiagnosis) {
  const ScratchFolder folder;
  const std::string study = folder.write("s.toml", short_study), recording = folder.file("r.csv");
  ASSERT_EQ(driftscope("simulate " + study + " -o " + recording).code, 0);
  const Answer a = driftscope("diagnose " + study + " " + recording +
                              " --advise nosuch,fixed_drift,temperature_drift --progress json");
  EXPECT_EQ(a.code, usage_error);
  for (const char* part :
       {"no term or parameter 'nosuch'", "nothing of fixed_drift can be asked for",
        "temperature_drift follows the temperature"})
    EXPECT_NE(a.err.find(part), std::string::npos) << a.err;
  EXPECT_EQ(a.err.find("\"done\""), std::string::npos) << "nothing was begun: " << a.err;
}

/// A recording with one sample far from those around it.
std::string with_spike(const std::string& recording) {
  std::string text = text_of(recording);
  std::vector<std::size_t> lines;
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; ++at)
    lines.push_back(at + 1);
  const std::size_t header = text.rfind('\n', text.find("acc_y")) + 1;
  const auto column =
      std::count(text.begin() + static_cast<std::ptrdiff_t>(header),
                 text.begin() + static_cast<std::ptrdiff_t>(text.find("acc_y")), ',');
  std::size_t at = lines[lines.size() / 2];
  for (std::ptrdiff_t i = 0; i < column; ++i) at = text.find(',', at) + 1;
  const std::size_t end = text.find(',', at);
  return text.replace(
      at, end - at,
      fmt::format("{:.9f}", std::stod(text.substr(at, end - at)) + 0.002));  // 2 mg of 5 ug
}

TEST(Program, ALoneSpikeIsInTheShortAnswers) {
  const ScratchFolder folder;
  const std::string study = folder.write("s.toml", short_study), recording = folder.file("r.csv");
  ASSERT_EQ(driftscope("simulate " + study + " -o " + recording).code, 0);
  const std::string spiked = folder.write("spiked.csv", with_spike(recording));
  for (const std::string command : {"identify ", "diagnose "}) {
    const Answer a = driftscope(command + study + " " + spiked + " --progress none");
    ASSERT_EQ(a.code, 0) << a.err;
    EXPECT_NE(a.out.find("Outliers: 1 isolated sample is"), std::string::npos) << a.out;
    EXPECT_NE(a.out.find("(acc_y in position"), std::string::npos) << a.out;
    EXPECT_EQ(driftscope(command + study + " " + recording).out.find("Outliers:"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace drift::arguments_test
