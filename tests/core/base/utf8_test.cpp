#include "core/base/utf8.hpp"

#include <gtest/gtest.h>

namespace drift::utf8_test {
namespace {

TEST(Utf8, WhatIsWellFormedStaysAndTheRestIsShown) {
  const std::string good = "K\xc3\xb6ln \xe2\x88\x9e \xf0\x9f\x9b\xb0";
  EXPECT_TRUE(valid_utf8(good));
  EXPECT_EQ(utf8_text(good), good);
  EXPECT_EQ(terminal_text(good), good);
  // Latin-1; an overlong slash; a surrogate; beyond the last character; a torn one.
  for (const auto& [bytes, shown] : {std::pair<std::string, std::string>{"K\xf6ln", "K\\xf6ln"},
                                     {"\xc0\xaf", "\\xc0\\xaf"},
                                     {"\xed\xa0\x80", "\\xed\\xa0\\x80"},
                                     {"\xf4\x90\x80\x80", "\\xf4\\x90\\x80\\x80"},
                                     {"a\xe2\x88", "a\\xe2\\x88"}}) {
    EXPECT_FALSE(valid_utf8(bytes));
    EXPECT_EQ(utf8_text(bytes), shown);
  }
}

TEST(Utf8, NothingSteersATerminal) {
  EXPECT_EQ(terminal_text("\x1b[31mred\x07\r\n\tb\x7f"), "\\x1b[31mred\\x07\\x0d\n\tb\\x7f");
  EXPECT_EQ(terminal_text("\xc2\x9b"
                          "31m"),
            "\\u009b31m");  // the one-character form of ESC [
  EXPECT_EQ(terminal_text("\xe2\x80\xae"
                          "gpj.exe"),
            "\\u202egpj.exe");
  for (int byte = 0; byte < 256; ++byte)
    for (const char c : terminal_text(std::string(1, static_cast<char>(byte))))
      EXPECT_TRUE((c >= 0x20 && c < 0x7F) || c == '\n' || c == '\t') << byte;
}

TEST(Utf8, OnlyTheMiddleOfALongLineIsLeftOut) {
  const std::string line = "begin " + std::string(100000, 'x') + " end";
  const std::string text = shortened_lines("short\n" + line + "\nshort\n", 300);
  EXPECT_LT(text.size(), 400u);
  EXPECT_EQ(text.substr(0, 12), "short\nbegin ");
  EXPECT_EQ(text.substr(text.size() - 11), " end\nshort\n");
  EXPECT_EQ(shortened_lines("short\n", 300), "short\n");
  std::string many;
  for (int i = 0; i < 1000; ++i) many += "\xc3\xb6";
  EXPECT_TRUE(valid_utf8(shortened_lines(many, 100))) << "no character is cut";
}

}  // namespace
}  // namespace drift::utf8_test
