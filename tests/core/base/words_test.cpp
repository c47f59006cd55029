#include "core/base/words.hpp"

#include <gtest/gtest.h>

#include "tests/support/program.hpp"

namespace drift::words_test {
namespace {

TEST(ShellWord, IsOneArgumentOfAShellWhateverIsInIt) {
  EXPECT_EQ(shell_word("out/lab_2.toml"), "out/lab_2.toml");
  EXPECT_EQ(shell_word("Prüfung.csv"), "Prüfung.csv");
  EXPECT_EQ(shell_word("my study.toml"), "'my study.toml'");
  for (const char* name : {"a b", "it's", "'", "''", "$HOME", "a;b", "~", "a\"b\\", "*", "", "a\nb",
                           "`x`", "plain", "(x)", "a#b", "#b", "a!b", "a&b|c<d>e"})
    EXPECT_EQ(test::run_program("/usr/bin/printf", "'%s|' " + shell_word(name) + " end").out,
              std::string(name) + "|end|");
  EXPECT_EQ(shell_words({"a.csv", "b c.csv"}), "a.csv 'b c.csv'");
}

TEST(CsvField, IsQuotedWhereAReaderWouldTakeItApart) {
  EXPECT_EQ(csv_field("eq5 of 1962"), "eq5 of 1962");
  EXPECT_EQ(csv_field("a, b"), "\"a, b\"");
  EXPECT_EQ(csv_field("2\" bore"), "\"2\"\" bore\"");
  EXPECT_EQ(csv_field("no. #3"), "\"no. #3\"");
  EXPECT_EQ(csv_field("two\nlines"), "\"two\nlines\"");
}

TEST(CsvNumber, ReadsBackAsItIsAndIsNothingWhereThereIsNone) {
  EXPECT_EQ(csv_number(0.1), "0.1");
  EXPECT_EQ(std::stod(csv_number(1.0 / 3.0)), 1.0 / 3.0);
  EXPECT_EQ(csv_number(std::nan("")), "");
  EXPECT_EQ(csv_number(-HUGE_VAL), "");
}

}  // namespace
}  // namespace drift::words_test
