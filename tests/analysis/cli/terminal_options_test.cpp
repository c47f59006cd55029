// --quiet, --color, --set of lists: what every command takes.
#include "core/base/check.hpp"
#include "tests/support/program.hpp"
#include "tests/support/short_study.hpp"
#include "tests/support/terminal.hpp"

namespace drift::terminal_options_test {
namespace {

using namespace drift::test;

constexpr const char* escape = "\x1b[";

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Quiet, NothingIsPrintedWhereFilesTakeWhatWasAskedFor) {
  const ScratchFolder folder;
  const std::string study = folder.write("s.toml", short_study);
  const Answer a = driftscope("identify " + study + " --quiet -o " + folder.file("out"));
  EXPECT_EQ(a.code, 0) << a.err;
  EXPECT_EQ(a.out, "");
  EXPECT_EQ(a.err, "");
  EXPECT_TRUE(std::filesystem::exists(folder.file("out") + "/report.html"));
}

TEST(Quiet, WhatWasAskedForIsPrintedWhereNoFileTakesIt) {
  const ScratchFolder folder;
  const std::string study = folder.write("s.toml", short_study);
  const Answer loud = driftscope("check " + study), quiet = driftscope("check --quiet " + study);
  EXPECT_FALSE(loud.out.empty());
  EXPECT_EQ(loud.out, quiet.out);
  EXPECT_EQ(driftscope("--quiet check " + study).out, loud.out);
}

TEST(Quiet, ExportsAndReportsOfStudiesAreFiles) {
  const ScratchFolder folder;
  const std::string out = folder.file("out"), study = folder.write("s.toml", cheap_study());
  for (const std::string& line : std::vector<std::string>{
           "run " + study + " --runs 8 --threads 1 -o " + out, "export " + out + " --format json",
           "export " + out + " --format hdf5 -o " + folder.file("x.h5"), "report " + out,
           "report " + out + " --full"}) {
    const Answer a = driftscope(line + " --quiet");
    EXPECT_EQ(a.code, 0) << line << ": " << a.err;
    EXPECT_EQ(a.out + a.err, "") << line;
  }
  EXPECT_FALSE(driftscope("report " + out).out.empty());
  EXPECT_FALSE(driftscope("status " + out + " --quiet").out.empty()) << "no file takes it";
  // Of other folders the answer is where the report is.
  const std::string other = folder.file("other");
  ASSERT_EQ(driftscope("identify " + study + " --quiet -o " + other).code, 0);
  EXPECT_EQ(driftscope("report " + other + " --quiet").out, other + "/report.html\n");
}

TEST(Quiet, ErrorsAreToldAllTheSame) {
  const ScratchFolder folder;
  const Answer a = driftscope("check --quiet " + folder.write("s.toml", "schema = 1\n[plna]\n"));
  EXPECT_EQ(a.code, static_cast<int>(ExitCode::config));
  EXPECT_TRUE(has(a.err, "unknown key 'plna'")) << a.err;
}

/// A script gives it to every command, before or behind its name.
TEST(Threads, EveryCommandTakesTheirNumber) {
  const ScratchFolder folder;
  const std::string study = folder.write("s.toml", cheap_study()), out = folder.file("out"),
                    run = "run " + study + " --runs 8 -o " + out;
  EXPECT_TRUE(has(driftscope(run + " --dry-run --threads 2").out, " with 2 threads"));
  EXPECT_TRUE(has(driftscope("--threads 1 " + run + " --dry-run").out, " with 1 threads"));
  for (const std::string& line : std::vector<std::string>{
           run, "status " + out, "report " + out, "replay " + out + " --run 3",
           "verify " + out + " --sample 100%", "export " + out + " --format csv", "check " + study,
           "rank " + study, "identify " + study,
           "simulate " + study + " -o " + folder.file("r.csv"), "look " + folder.file("r.csv"),
           "terms", "version", "schema"}) {
    EXPECT_EQ(driftscope(line + " --threads 1").code, 0) << line;
    EXPECT_EQ(driftscope("--threads 1 " + line).code, 0) << line;
  }
  EXPECT_EQ(driftscope("status " + out + " --threads 0").code, static_cast<int>(ExitCode::usage));
}

TEST(Color, VerdictsAreColouredOnRequestAndNeverInAPipeOrFile) {
  const ScratchFolder folder;
  const std::string run =
      "identify " + folder.write("s.toml", short_study) + " --full --progress none";
  const Answer plain = driftscope(run), never = driftscope(run + " --color never"),
               always = driftscope(run + " --color always -o " + folder.file("out"));
  EXPECT_FALSE(has(plain.out, escape));
  EXPECT_EQ(plain.out, never.out);
  EXPECT_TRUE(has(always.out, "\x1b[32mok\x1b[0m")) << always.out;
  EXPECT_FALSE(has(text_of(folder.file("out") + "/report.html"), escape));
  EXPECT_EQ(driftscope(run + " --color purple").code, static_cast<int>(ExitCode::usage));
}

TEST(Color, ATerminalHasItUnlessNoColorSaysNo) {
  if (!has_terminal()) GTEST_SKIP() << "no script(1) here";
  const ScratchFolder folder;
  const std::string run = std::string(DRIFT_PROGRAM) + " identify " +
                          folder.write("s.toml", short_study) + " --progress none";
  const auto on_terminal = [&](const std::string& environment) {
    return shown_on_a_terminal(folder, "env " + environment + " " + run);
  };
  EXPECT_TRUE(has(on_terminal("-u NO_COLOR TERM=xterm"), escape));
  EXPECT_FALSE(has(on_terminal("NO_COLOR=1 TERM=xterm"), "\x1b[32m"));
  EXPECT_FALSE(has(on_terminal("-u NO_COLOR TERM=dumb"), "\x1b[32m"));
}

TEST(SetList, AddsToAListOfTheFile) {
  const ScratchFolder folder;
  const std::string study = test::config("table1.toml");
  const Answer one = driftscope("check " + study + " --set truth.terms+=drift_ramp.y");
  EXPECT_EQ(one.code, 0) << one.err;
  EXPECT_TRUE(has(one.out, "fixed_drift, g_drift, gyro_misalignment, drift_ramp.y")) << one.out;
  const Answer two =
      driftscope("check " + study + " --set 'filter.eq5.terms+=[\"g2_drift\", \"torquer_scale\"]'");
  EXPECT_EQ(two.code, 0) << two.err;
  EXPECT_TRUE(has(two.out, "g2_drift, gyro_misalignment, torquer_scale")) << two.out;
}

TEST(SetList, RefusesWhatIsNoList) {
  const auto refused = [](const std::string& set) {
    const Answer a = driftscope("check " + test::config("table1.toml") + " --set '" + set + "'");
    EXPECT_EQ(a.code, static_cast<int>(ExitCode::config)) << set;
    return a.err;
  };
  EXPECT_TRUE(has(refused("plan.dwell+=20 min"), "cannot be added to (expected a list)"));
  EXPECT_TRUE(has(refused("blind.plans+=six"), "nothing stands there that could be added to"));
  EXPECT_TRUE(has(refused("truth.terms+=no_such_term"), "unknown term 'no_such_term'"));
}

/// The keys that `check` prints for values of the file, and what it prints of each.
std::vector<std::pair<std::string, std::string>> given_values(const std::string& study) {
  std::istringstream lines(driftscope("check " + study).out);
  std::vector<std::pair<std::string, std::string>> all;
  for (std::string line; std::getline(lines, line) && !line.empty();) {  // the positions follow
    const auto end = line.find("  "), start = line.find_first_not_of(' ', end);
    if (!line.ends_with(" default") && start != std::string::npos)
      all.emplace_back(line.substr(0, end), line.substr(start, line.find("  ", start) - start));
  }
  return all;
}

TEST(Names, SetTakesEveryKeyThatCheckPrints) {
  const ScratchFolder folder;
  std::string text = text_of(std::string(DRIFT_SOURCE_DIR) + "/configs/table1.toml");
  text.replace(text.find("name     = \"eq6\""), 16, "name     = \"eq. (6)\"");
  const std::string study =
      folder.write("s.toml", text + "[sweep]\n\"truth.parameters.eta_x\" = [\"1 arcsec\"]\n");
  const auto values = given_values(study);
  EXPECT_GT(values.size(), 100u);
  std::string sets;
  for (const auto& [key, value] : values)
    if (!key.ends_with(".terms") && value.find('(') == std::string::npos)
      sets += " --set '" + key + "=" + value + "'";
  EXPECT_TRUE(has(sets, "'filter.\"eq. (6)\".coupling=eq6'")) << sets;
  EXPECT_TRUE(has(sets, "'sweep.\"truth.parameters.eta_x\"=[")) << sets;
  const Answer a = driftscope("check " + study + sets);
  EXPECT_EQ(a.code, 0) << a.err;
}

TEST(Names, TermsTakesWhatStudiesAndReportsCallThem) {
  for (const char* name : {"g_drift", "g_drift.x", "eta", "eta_x"}) {
    const Answer a = driftscope(std::string("terms ") + name);
    EXPECT_EQ(a.code, 0) << a.err;
    EXPECT_TRUE(has(a.out, name[0] == 'g' ? "g_drift: " : "gyro_misalignment: ")) << a.out;
  }
}

}  // namespace
}  // namespace drift::terminal_options_test
