// Commands that the program proposes can be copied into a shell, whatever files are called.
#include <gtest/gtest.h>

#include "core/base/words.hpp"
#include "tests/support/program.hpp"

namespace drift::copied_commands_test {
namespace {

using test::Answer;
using test::driftscope;
using test::ScratchFolder;

/// The arguments of a proposed command, which stands in a text before `end`.
std::string arguments_of(std::string text, const std::string& command, const std::string& end) {
  for (std::size_t at = 0; (at = text.find("\n  ", at)) != std::string::npos;)
    text.replace(at, 3, " ");  // a line goes on
  const std::string program = "driftscope ";
  const auto from = text.find(program + command), to = text.find(end, from);
  return from == std::string::npos || to == std::string::npos
             ? "no " + command + " in: " + text
             : text.substr(from + program.size(), to - from - program.size());
}

TEST(CopiedCommands, OfFilesWithBlanksAndQuotesRun) {
  const ScratchFolder folder;
  const std::string study = folder.write("it's my study.toml", test::cheap_study()),
                    given = shell_word(study);
  const Answer ranked = driftscope("rank " + given);
  ASSERT_EQ(ranked.code, 0) << ranked.err;
  const Answer again = driftscope(arguments_of(ranked.out, "rank", " --improve"));
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(again.out, ranked.out);
  const Answer identified = driftscope("identify " + given);
  ASSERT_EQ(identified.code, 0) << identified.err;
  EXPECT_EQ(driftscope(arguments_of(identified.out, "rank", " --improve")).out, ranked.out);
  const std::string recording = shell_word(folder.file("first log.csv"));
  ASSERT_EQ(driftscope("simulate " + given + " -o " + recording).code, 0);
  const Answer looked = driftscope("look " + recording);
  EXPECT_NE(looked.out.find("identify lab.toml " + recording + "\n"), std::string::npos)
      << looked.out;
}

TEST(CopiedCommands, ThatProposePositionsWriteThem) {
  const ScratchFolder folder;
  folder.write("s.toml", test::cheap_study());
  const auto there = [&](const std::string& arguments) {
    return test::run_program(
        "/bin/bash", "-c \"cd '" + folder.path() + "'; '" DRIFT_PROGRAM "' " + arguments + "\"");
  };
  for (const char* command : {"rank", "identify"}) {
    const Answer first = there(std::string(command) + " s.toml");
    ASSERT_EQ(first.code, 0) << first.err;
    std::filesystem::remove_all(folder.file("out"));
    const Answer proposed = there(arguments_of(first.out, "rank", " proposes"));
    ASSERT_EQ(proposed.code, 0) << first.out << proposed.err;
    EXPECT_TRUE(std::filesystem::exists(folder.file("out/rank/improved.toml"))) << proposed.out;
    EXPECT_EQ(there("rank out/rank/improved.toml").code, 0);
  }
}

TEST(CopiedCommands, OfANewStudyRun) {
  const ScratchFolder folder;
  const std::string made = shell_word(folder.file("a new study.toml"));
  const Answer fresh = driftscope("new study -o " + made);
  ASSERT_EQ(fresh.code, 0) << fresh.err;
  EXPECT_EQ(driftscope(arguments_of(fresh.out, "check", "\n")).code, 0) << fresh.out;
}

TEST(CopiedCommands, OfAFolderWithABlankRun) {
  const ScratchFolder folder;
  const std::string study = folder.write("s.toml", test::cheap_study()),
                    out = folder.file("my results");
  ASSERT_EQ(driftscope("run " + study + " --runs 8 -o " + shell_word(out)).code, 0);
  std::filesystem::remove(out + "/manifest.json");
  const Answer lost = driftscope("status " + shell_word(out));
  EXPECT_EQ(lost.code, 7);
  EXPECT_NE(lost.err.find("-o " + shell_word(out) + ": it is made anew"), std::string::npos)
      << lost.err;
}

}  // namespace
}  // namespace drift::copied_commands_test
