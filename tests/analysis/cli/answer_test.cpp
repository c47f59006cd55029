// The answer comes first and in brief, the rest on request; a stop says what is kept.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "analysis/report/page/escape.hpp"
#include "analysis/report/page/report.hpp"
#include "tests/support/program.hpp"
#include "tests/support/short_study.hpp"
#include "tests/support/terminal.hpp"

namespace drift::answer_test {
namespace {

using namespace drift::test;

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(Brief, WhatIsWrongWithTheInputHasRoomAndNoSentenceEndsInBrackets) {
  std::string verdict =
      "Verdict unexplained: something is missing. The nearest known (one; or "
      "another. Of both much is written";
  for (int k = 0; k < 200; ++k) verdict += " here";
  report::InBrief brief{.verdict = verdict + ").", .next = "Next: correct it."};
  brief.more.add(Weight::note, "A note.");
  brief.more.add(Weight::wrong, "Gimbals: gimbal_inner reads 3.01 deg too much.");
  const std::string said = report::brief_text(brief, 80);
  EXPECT_NE(said.find("reads 3.01 deg too much"), std::string::npos) << said;
  EXPECT_NE(said.find("something is missing.\n"), std::string::npos) << said;
  EXPECT_EQ(said.find("nearest known"), std::string::npos) << said;
}

TEST(Brief, KeepsVerdictAndNextStepAndCutsWhatIsBetween) {
  report::InBrief brief;
  for (int k = 0; k < 40; ++k) brief.verdict += "verdict ";
  for (int k = 0; k < 90; ++k) brief.more.add(Weight::note, "said " + std::string(40, 'x'));
  brief.next = "Next: do this.";
  for (const std::size_t width : {80u, 120u}) {
    const auto lines = lines_of(report::brief_text(brief, width));
    EXPECT_EQ(lines.size(), report::most_brief_lines);
    EXPECT_TRUE(lines.front().starts_with("verdict"));
    EXPECT_EQ(lines.back(), "Next: do this.");
    for (const std::string& line : lines) EXPECT_LE(report::display_width(line), width);
  }
  brief.more = {};
  for (int k = 0; k < 200; ++k) brief.verdict += "verdict ";
  const auto cut = lines_of(report::brief_text(brief));
  EXPECT_EQ(cut.size(), report::most_brief_lines);
  EXPECT_TRUE(cut[report::most_brief_lines - 2].ends_with(" ...")) << "what is cut is said";
}

TEST(Brief, WhatWasAskedForHasRoomWhateverTheVerdictTakes) {
  report::InBrief brief{.verdict = "Seen: a lot", .asked = 1, .next = "Next: do this."};
  for (int k = 0; k < 200; ++k) brief.verdict += "; and more";
  std::string better = "A better plan: a sigma";
  for (int k = 0; k < 20; ++k) better += fmt::format(" from {} to {}", k, k + 1);
  brief.more.add(Weight::note, better + " (1 to 9 elsewhere).");
  brief.more.add(Weight::note, "A note.");
  const std::string said = report::brief_text(brief);
  EXPECT_LE(lines_of(said).size(), report::most_brief_lines);
  EXPECT_NE(said.find("(1 to 9 elsewhere)."), std::string::npos) << said;
  EXPECT_TRUE(said.starts_with("Seen: a lot;")) << said;
  brief.asked = 0;
  EXPECT_EQ(report::brief_text(brief).find("A better plan"), std::string::npos);
}

TEST(Brief, WholeItHasEverySentence) {
  report::InBrief brief{.verdict = "Verdict.", .next = "Next: do this."};
  for (int k = 0; k < 40; ++k) brief.more.add(Weight::note, fmt::format("Said {}.", k));
  const auto lines = lines_of(report::whole_text(brief));
  ASSERT_EQ(lines.size(), 42u);
  EXPECT_EQ(lines.front(), "Verdict.");
  EXPECT_EQ(lines[40], "Said 39.");
  EXPECT_EQ(lines.back(), "Next: do this.");
}

TEST(Brief, AnAbbreviationIsNoEndOfASentence) {
  report::InBrief brief;
  brief.verdict = "The first sentence is whole. The second says that eq. (5) is 0 and eq. (6) is 1";
  for (int k = 0; k < 200; ++k) brief.verdict += " and more";
  EXPECT_EQ(report::brief_text(brief), "The first sentence is whole. (1 more sentence: --full)\n");
}

TEST(Brief, SentencesThatHaveNoRoomAreCountedWithinTheLines) {
  report::InBrief brief{.verdict = "Verdict.", .next = "Next: do this."};
  const auto add_lines = [&](std::size_t count, const std::string& line) {
    for (std::size_t k = 0; k < count; ++k) brief.more.add(Weight::note, line);
  };
  add_lines(8, std::string(79, 'x') + '.');
  EXPECT_EQ(report::brief_text(brief).find("--full"), std::string::npos) << "all have room";
  // The count takes the line of a sentence where no line has room for it.
  brief.more.add(Weight::note, "Two are said (eq. 5. or 6). In one text.");
  const std::string said = report::brief_text(brief);
  EXPECT_EQ(lines_of(said).size(), report::most_brief_lines);
  EXPECT_TRUE(said.ends_with("x.\n(3 more sentences: --full)\nNext: do this.\n")) << said;
  // A last line that is short has it behind its sentence.
  brief.more = {};
  add_lines(7, std::string(79, 'x') + '.');
  add_lines(2, "One more.");
  EXPECT_TRUE(report::brief_text(brief).ends_with(
      "x.\nOne more. (1 more sentence: --full)\nNext: do this.\n"))
      << report::brief_text(brief);
  // What a text is cut by at the end of a sentence is counted too.
  brief.more = {};
  add_lines(7, std::string(79, 'x') + '.');
  add_lines(1, "Said. Not said, and this is why: " + std::string(50, 'y') + ".");
  EXPECT_TRUE(
      report::brief_text(brief).ends_with("\nSaid. (1 more sentence: --full)\nNext: do this.\n"))
      << report::brief_text(brief);
}

/// The answer of a command: what it prints up to the first empty line.
std::string answer_of(const std::string& out) {
  return out.substr(0, out.find("\n\n"));
}

TEST(Terminal, FirstTheAnswerInTenLinesThenWhereThenOnRequestTheRest) {
  const ScratchFolder folder;
  const std::string study = folder.write("s.toml", short_study), recording = folder.file("r.csv");
  ASSERT_EQ(driftscope("simulate " + study + " -o " + recording).code, 0);
  for (const std::string& command : {"identify " + study, "identify " + study + " " + recording,
                                     "rank " + study, "diagnose " + study + " " + recording}) {
    const std::string quietly =
        command + " --progress none -o " + folder.file(command.substr(0, 4));
    const Answer brief = driftscope(quietly), full = driftscope(quietly + " --full");
    ASSERT_EQ(brief.code, 0) << command << brief.err;
    const auto answer = lines_of(answer_of(brief.out));
    EXPECT_FALSE(answer.empty()) << command;
    EXPECT_LE(answer.size(), 10u) << brief.out;
    for (const std::string& line : answer) {
      const bool path = !has(line.substr(line.find_first_not_of(' ')), " ");  // cannot be broken
      EXPECT_TRUE(path || report::display_width(line) <= 80u) << line;
    }
    EXPECT_TRUE(has(brief.out, "/report.html\n")) << brief.out;
    EXPECT_TRUE(has(brief.out, "--full")) << brief.out;
    EXPECT_EQ(lines_of(full.out).front(), answer.front()) << "verdict first, here too";
    EXPECT_FALSE(has(full.out, ": --full)")) << "nothing is left out: " << full.out;
    EXPECT_GT(lines_of(full.out).size(), lines_of(brief.out).size() + 10) << command;
  }
}

TEST(Terminal, WithJsonTheDocumentAloneIsOnStandardOutput) {
  const ScratchFolder folder;
  const std::string study = folder.write("s.toml", short_study), recording = folder.file("r.csv");
  ASSERT_EQ(driftscope("simulate " + study + " -o " + recording).code, 0);
  const std::vector<std::pair<std::string, std::string>> documents = {
      {"identify " + study, "identification.json"},
      {"identify " + study + " " + recording, "identification.json"},
      {"rank " + study, "rank.json"},
      {"diagnose " + study + " " + recording, "diagnosis.json"},
      {"run " + study + " --runs 4", "summary.json"}};
  for (const auto& [command, file] : documents) {
    const std::string out = folder.file(file + "_of");
    const Answer a = driftscope(command + " --json -o " + out);
    ASSERT_EQ(a.code, 0) << command << a.err;
    EXPECT_EQ(a.out, text_of(out + "/" + file)) << command;
    EXPECT_TRUE(nlohmann::json::accept(a.out)) << command;
    EXPECT_TRUE(has(a.err, "Written to " + out + ": ")) << a.err;
  }
  EXPECT_EQ(driftscope("run " + study + " --json --dry-run").code, 2);
}

TEST(Terminal, ABarThatEndsStandsBeforeTheAnswer) {
  if (!has_terminal()) GTEST_SKIP() << "no script(1) here";
  const ScratchFolder folder;
  const std::string said =
      shown_on_a_terminal(folder, std::string(DRIFT_PROGRAM) + " identify " +
                                      folder.write("s.toml", short_study) + " --color never");
  const auto bar = said.find("estimates [####################]"),
             answer = said.find("Filter corrected: of");
  ASSERT_NE(bar, std::string::npos) << said;
  ASSERT_NE(answer, std::string::npos) << said;
  EXPECT_LT(bar, answer);
  EXPECT_NE(said.find('\n', bar), std::string::npos);
  EXPECT_LT(said.find('\n', bar), answer) << "the answer begins a line";
}

/// Stops a command a moment after its progress says something; its exit code. As jobs of a shell's
/// own, commands in the background do not ignore the signal.
int stopped(const ScratchFolder& folder, const std::string& command) {
  const std::string script = folder.write(
      "stop.sh", "set -m\n" + command + " >/dev/null 2>'" + folder.file("err") +
                     "' &\npid=$!\nuntil [ -s '" + folder.file("err") +
                     "' ]; do sleep 0.02; done\nsleep 0.5\nkill -INT $pid\nwait $pid\n");
  return WEXITSTATUS(std::system(("bash '" + script + "' 2>/dev/null").c_str()));
}

TEST(Stopped, SaysInOneLineWhatIsKeptWhatIsLostAndHowToGoOn) {
  const ScratchFolder folder;
  const std::string err = folder.file("err"), out = folder.file("out");
  EXPECT_EQ(stopped(folder, "'" DRIFT_PROGRAM "' rank " + test::config("table1.toml") +
                                " --improve 99 --progress plain"),
            130);
  EXPECT_TRUE(text_of(err).ends_with(
      "\nstopped: nothing was stored, what was computed is lost; the same command begins anew\n"))
      << text_of(err);

  const std::string study = folder.write(
      "s.toml",
      "schema = 1\ntitle = \"synthetic ms=20\"\n[site]\nlatitude = \"45.75 deg\"\n[plan]\n"
      "preset = \"six\"\n[truth]\ncoupling = \"eq5\"\n[[filter]]\nname = \"eq5\"\n"
      "coupling = \"eq5\"\n[monte_carlo]\nruns = 4000\n");
  EXPECT_EQ(stopped(folder, "'" DRIFT_SYNTHETIC "' run " + study + " -o " + out), 130);
  const auto said = lines_of(text_of(err));
  ASSERT_FALSE(said.empty());
  EXPECT_TRUE(said.back().starts_with("stopped: ")) << said.back();
  EXPECT_TRUE(has(said.back(), " runs are stored in " + out)) << said.back();
  EXPECT_TRUE(has(said.back(), "of unfinished blocks are kept; the same command goes on"));
  EXPECT_FALSE(has(said.back(), ", 0 of unfinished")) << "what is kept is counted: " << said.back();
}

}  // namespace
}  // namespace drift::answer_test
