// The manual page says what `help` says: every command, argument and option, in the same words.
#include <cctype>
#include <sstream>

#include "tests/support/program.hpp"

namespace drift::man_page_test {
namespace {

using namespace drift::test;

/// Words a blank apart, roff taken out.
std::string words_of(std::string text) {
  for (const auto& [roff, plain] : {std::pair{"\\-", "-"}, {"\\&", ""}, {"\\e", "\\"}})
    for (std::size_t at = 0; (at = text.find(roff, at)) != std::string::npos;)
      text.replace(at, 2, plain);
  std::istringstream lines(text);
  std::string words;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(".B ")) line = line.substr(3);
    if (line.starts_with(".SS ") || line.starts_with(".SH ")) line = line.substr(4);
    if (line.starts_with(".TP") || line.starts_with(".PP")) continue;
    std::istringstream parts(line);
    for (std::string word; parts >> word;) words += word + " ";
  }
  std::erase(words, '"');
  std::erase(words, '\'');
  return words;
}

/// What `help` lists under its headings, each entry in one line of words: "-o,--output TEXT
/// folder".
std::vector<std::string> entries(const std::string& help) {
  std::vector<std::string> found;
  std::istringstream lines(help);
  bool listing = false;
  for (std::string line; std::getline(lines, line);) {
    const auto indent = line.find_first_not_of(' ');
    if (indent == std::string::npos || indent == 0) {
      listing = line.ends_with(":") && !line.starts_with("Usage");
      continue;
    }
    if (!listing) continue;
    if (indent == 2)
      found.push_back(words_of(line));
    else if (!found.empty())
      found.back() += words_of(line);
  }
  return found;
}

/// The part of the page about one command.
std::string section(const std::string& page, const std::string& command) {
  const auto at = page.find(".SS \"" + command + "\"\n");
  if (at == std::string::npos) return "";
  return page.substr(at, std::min(page.find("\n.SS ", at), page.find("\n.SH ", at)) - at);
}

TEST(ManPage, SaysWhatHelpSays) {
  const Answer man = driftscope("help --man");
  ASSERT_EQ(man.code, 0) << man.err;
  std::size_t commands = 0;
  for (const std::string& entry : entries(driftscope("help").out)) {
    if (entry.starts_with("-")) {
      EXPECT_NE(words_of(man.out).find(entry), std::string::npos) << entry;
      continue;
    }
    ++commands;
    const std::string name = entry.substr(0, entry.find(' ')), part = section(man.out, name);
    ASSERT_FALSE(part.empty()) << name;
    EXPECT_NE(words_of(part).find(entry), std::string::npos) << "its title: " << entry;
    const Answer help = driftscope("help " + name);
    const auto listed = entries(help.out);
    ASSERT_FALSE(listed.empty()) << help.out;
    for (const std::string& option : listed)
      EXPECT_NE(words_of(part).find(option), std::string::npos)
          << name << ": " << option << "\nin " << words_of(part);
    std::size_t items = 0;
    for (std::size_t at = 0; (at = part.find(".TP\n", at)) != std::string::npos; ++at) ++items;
    EXPECT_EQ(items, listed.size()) << name << " has an option that help does not list";
    const auto example = help.out.find("Example: ");
    ASSERT_NE(example, std::string::npos);
    EXPECT_NE(words_of(part).find(words_of(help.out.substr(example))), std::string::npos) << name;
  }
  EXPECT_GE(commands, 20u);
}

TEST(ManPage, HasEveryExitCode) {
  const std::string page = driftscope("help --man").out;
  const std::string part = page.substr(page.find(".SH EXIT STATUS"));
  for (const int code : {0, 1, 2, 3, 4, 5, 6, 7, 8, 75, 130, 143})
    EXPECT_NE(part.find(".B \"" + std::to_string(code) + "\"\n"), std::string::npos) << code;
}

TEST(ManPage, IsReadByManWithoutComplaint) {
  if (std::system("command -v groff >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "groff is not installed";
  const ScratchFolder scratch;
  const std::string page = scratch.write("driftscope.1", driftscope("help --man").out);
  const std::string log = scratch.file("log"), text = scratch.file("text");
  ASSERT_EQ(
      std::system(("groff -man -Tascii -P-cbu -ww " + page + " >" + text + " 2>" + log).c_str()),
      0);
  EXPECT_EQ(text_of(log), "");
  EXPECT_NE(text_of(text).find("--output"), std::string::npos);
}

TEST(ManPage, GoesWithNoCommand) {
  EXPECT_EQ(driftscope("help --man run").code, usage_error);
}

}  // namespace
}  // namespace drift::man_page_test
