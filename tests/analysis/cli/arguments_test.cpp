// Mistakes of the command line: what is said of them.
#include <gtest/gtest.h>

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
                "(expected a whole number from 0 to 2^63-1, or \"0x...\" up to 2^64-1)");
  expect_says(refusal("simulate x.toml -o x.csv --run -1"),
              "(expected a whole number from 0 to 999999999)");
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

TEST(Arguments, AnEmptyNameIsNoPlaceForResults) {
  for (const char* command :
       {"run x.toml -o ''", "simulate x.toml -o ''", "export x --format csv -o ''",
        "replay x --run 1 --trace ''", "identify x.toml -o ''", "rank x.toml -o ''",
        "blind x.toml -o ''", "diagnose x.toml r.csv -o ''"})
    expect_says(refusal(command), "the name is empty (expected a file or folder)");
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

}  // namespace
}  // namespace drift::arguments_test
