// The number of the position under a name that says nothing.
#include "core/recording/own/guess_position.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <functional>

#include "recording_fixture.hpp"

namespace drift::guess_position_test {
namespace {

using namespace test;

/// A file of positions of 20 rows that stand in turns on three axes, the column `header` beside.
GuessedFile guess(const std::string& header, const std::function<std::string(int row)>& cell,
                  int positions = 6) {
  const Folder folder;
  std::string text = "time [s],acc_x [g],acc_y [g],acc_z [g]," + header + "\n";
  for (int row = 0; row < 20 * positions; ++row) {
    const int up = row / 20 % 3;
    const auto f = [&](int axis) { return (axis == up ? 1.0 : 0.0) + 1e-5 * std::sin(1.7 * row); };
    text +=
        fmt::format("{},{:.7f},{:.7f},{:.7f},{}\n", 10 * (row + 1), f(0), f(1), f(2), cell(row));
  }
  return guess_file(folder.write("own.csv", text));
}

std::string mapping(const GuessedFile& file) {
  std::string text;
  for (const GuessedColumn& c : file.columns)
    if (c.channel == "position") text = c.header.name + (c.by_values ? "*" : "");
  for (const auto& [label, number] : file.format.positions)
    text += fmt::format(" {}={}", label, number);
  return text;
}

TEST(GuessPosition, NumbersThatChangeWithTheAttitudeAreThoseOfPositions) {
  const auto number = [](int row) { return std::to_string(row / 20 + 1); };
  EXPECT_EQ(mapping(guess("Versuch", number)), "Versuch*");
  EXPECT_EQ(mapping(guess("Versuch [1]", number)), "Versuch*");
  const GuessedFile file = guess("Nr", [](int row) { return std::to_string(60 - row / 20 * 10); });
  EXPECT_EQ(mapping(file), "Nr* 60=1 50=2 40=3 30=4 20=5 10=6");
  const std::string section = recording_section(file);
  EXPECT_NE(section.find("position = \"Nr\""), std::string::npos) << section;
  EXPECT_NE(section.find("position by its numbers"), std::string::npos) << section;
}

TEST(GuessPosition, OtherWholeNumbersAreNot) {
  const std::array<std::pair<const char*, std::function<std::string(int)>>, 11> others{
      {{"Zaehler", [](int row) { return std::to_string(row); }},
       {"Stufe",
        [](int row) { return std::to_string(row / 40); }},  // two changes, every second turn
       {"Stunde", [](int row) { return std::to_string(7 + (row + 9) / 15); }},
       {"Datum", [](int row) { return std::to_string(20260314 + row / 20); }},
       {"Temp 2", [](int row) { return std::to_string(row / 20); }},
       {"Strom [A]", [](int row) { return std::to_string(row / 20); }},
       {"Strom_deg", [](int row) { return std::to_string(row / 20); }},
       {"Achse", [](int row) { return std::to_string(row / 20 % 3); }},
       {"Wert", [](int row) { return fmt::format("{}.5", row / 20); }},
       {"Gruppe", [](int row) { return std::to_string(row / 100); }},
       {"Luecke", [](int row) { return row == 50 ? "" : std::to_string(row / 20); }}}};
  for (const auto& [name, cell] : others) EXPECT_EQ(mapping(guess(name, cell)), "") << name;
  EXPECT_EQ(mapping(guess("A,B", [](int row) { return fmt::format("{0},{0}", row / 20); })), "")
      << "one of two";
}

TEST(GuessPosition, ANameThatSaysItGoesFirst) {
  const GuessedFile file =
      guess("Lage,Nr", [](int row) { return fmt::format("{},{}", row / 40 + 1, row / 20 + 1); });
  EXPECT_EQ(mapping(file), "Lage");
}

TEST(GuessPosition, NumbersUnderItsNameThatNoPlanHasAreListed) {
  const auto times = [](int factor, int first) {
    return [=](int row) { return std::to_string(first + row / 20 * factor); };
  };
  EXPECT_EQ(mapping(guess("Lage", times(1, 1))), "Lage");
  EXPECT_EQ(mapping(guess("Lage", times(2, 1))), "Lage") << "a part of a longer plan";
  EXPECT_EQ(mapping(guess("Lage", times(1, 0))), "Lage 0=1 1=2 2=3 3=4 4=5 5=6");
  EXPECT_EQ(mapping(guess("Lage", times(10, 10))), "Lage 10=1 20=2 30=3 40=4 50=5 60=6");
  EXPECT_EQ(mapping(guess("Lage", [](int row) { return std::to_string(row / 20 % 3); })), "Lage");
}

TEST(GuessPosition, ATextThatComesBackBetweenPositionsIsNone) {
  const auto between = [](const std::array<const char*, 5>& texts) {
    return [=](int row) { return std::string(texts[static_cast<std::size_t>(row / 20)]); };
  };
  const GuessedFile file = guess("Lage", between({"1", "dreht", "2", "dreht", "3"}), 5);
  EXPECT_EQ(mapping(file), "Lage dreht=0");
  EXPECT_NE(recording_section(file).find("turned where 'dreht' stands: check"), std::string::npos)
      << recording_section(file);
  EXPECT_EQ(mapping(guess("Lage", between({"auf", "dreht", "ab", "dreht", "Nord"}), 5)),
            "Lage auf=1 dreht=0 ab=2 Nord=3");
  EXPECT_EQ(mapping(guess("Lage", between({"auf", "ab", "auf", "Nord", "auf"}), 5)),
            "Lage auf=1 ab=2 Nord=3")
      << "a position to return to";
  EXPECT_EQ(mapping(guess("Lage", between({"1", "0", "2", "0", "3"}), 5)), "Lage");
  EXPECT_EQ(mapping(guess("Lage", between({"1", "1", "0", "2", "2"}), 5)), "Lage");
  // Numbers that no plan has are listed beside rows of no position, too: 0 is the first one then.
  EXPECT_EQ(mapping(guess("Lage", between({"0", "dreht", "1", "dreht", "2"}), 5)),
            "Lage 0=1 1=2 2=3 dreht=0");
  EXPECT_EQ(mapping(guess("Lage", between({"0", "-1", "1", "-1", "2"}), 5)), "Lage 0=1 1=2 2=3");
  EXPECT_EQ(mapping(guess("Lage", between({"10", "-1", "20", "-1", "30"}), 5)),
            "Lage 10=1 20=2 30=3");
}

TEST(GuessPosition, ZeroBetweenNumbersThatNoPlanHasIsNoPosition) {
  const auto guessed = [&](const std::function<std::string(int)>& cell) {
    return mapping(guess("Lage", cell));
  };
  const auto tens = [](int row) { return std::to_string(10 * (row / 20 + 1)); };
  const std::string listed = "Lage 10=1 20=2 30=3 40=4 50=5 60=6";
  // Two rows behind every position, the same and the first three rows, one place alone.
  EXPECT_EQ(guessed([&](int row) { return row % 20 > 17 ? "0" : tens(row); }), listed);
  EXPECT_EQ(guessed([&](int row) { return row % 20 > 17 || row < 3 ? "0" : tens(row); }), listed);
  EXPECT_EQ(guessed([&](int row) { return row % 20 > 14 || row < 5 ? "0" : tens(row); }), listed);
  EXPECT_EQ(guessed([&](int row) { return row > 36 && row < 40 ? "0" : tens(row); }), listed);
  EXPECT_EQ(guessed([&](int row) { return row < 3 ? "0" : tens(row); }), listed);
  EXPECT_EQ(guessed([](int row) { return std::to_string(10 * (row / 20)); }),
            "Lage 0=1 10=2 20=3 30=4 40=5 50=6");
}

}  // namespace
}  // namespace drift::guess_position_test
