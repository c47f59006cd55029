// `driftscope new` with logs whose columns need a closer look.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "tests/support/program.hpp"
#include "tests/support/short_study.hpp"

namespace drift::new_study_log_test {
namespace {

using namespace drift::test;

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// What stands before the first of two texts and after it.
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// A CSV file with the cells of a column as they are after `change`.
template <class Change>
std::string with_column(const std::string& text, const std::string& name, Change&& change) {
  std::istringstream lines(text);
  std::string out, line;
  std::ptrdiff_t column = -1;
  while (std::getline(lines, line)) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    if (column >= 0 && !line.starts_with('#'))
      cells[static_cast<std::size_t>(column)] = change(cells[static_cast<std::size_t>(column)]);
    if (const auto it = std::ranges::find(cells, name); it != cells.end())
      column = it - cells.begin();
    for (std::size_t i = 0; i < cells.size(); ++i) out += (i > 0 ? "," : "") + cells[i];
    out += "\n";
  }
  return out;
}

TEST(NewStudy, OneAccelerometerInAnotherUnitIsMappedWithTheUnitThatGravityTells) {
  const ScratchFolder folder;
  const std::string made = folder.write("made.toml", short_study), own = folder.file("own.csv");
  ASSERT_EQ(driftscope("simulate " + made + " -o " + own).code, 0);
  const std::string plain = with_column(text_of(own), "acc_y [g]", [](const std::string& cell) {
    return fmt::format("{:.9f}", 9.80665 * std::stod(cell));
  });
  for (const std::array<std::string, 3>& names :
       {std::array<std::string, 3>{"Kanal 1", "Kanal 2", "Kanal 3"}, {"acc_x", "acc_y", "acc_z"}}) {
    std::string text = plain;
    for (std::size_t a = 0; a < 3; ++a)
      text = replaced(text, fmt::format("acc_{} [g]", "xyz"[a]), names[a]);
    folder.write("own.csv", text);
    const std::string file = folder.file(names[0] + ".toml");
    const Answer a = driftscope("new diagnose " + own + " -o '" + file + "'");
    ASSERT_EQ(a.code, 0) << a.err;
    const std::string study = text_of(file);
    EXPECT_TRUE(has(study, fmt::format("acc_x = \"{} [g]\"", names[0]))) << study;
    EXPECT_TRUE(has(study, fmt::format("acc_y = \"{} [m/s^2]\"", names[1]))) << study;
    EXPECT_TRUE(has(study, "acc_y in [m/s^2] by its size: check")) << study;
    const Answer fit = driftscope("identify '" + file + "' " + own + " --quiet");
    EXPECT_EQ(fit.code, 0) << fit.err;
  }
}

TEST(NewStudy, ASampleThatDoesNotDivideAnHourIsNoMistake) {
  const ScratchFolder folder;
  const std::string made = folder.write("made.toml", short_study), own = folder.file("own.csv"),
                    file = folder.file("lab.toml");
  ASSERT_EQ(driftscope("simulate " + made + " -o " + own).code, 0);
  folder.write("own.csv", with_column(text_of(own), "time [s]", [](const std::string& cell) {
                 return fmt::format("{:.9f}", 1.0000213 * std::stod(cell));
               }));
  const Answer a = driftscope("new diagnose " + own + " -o " + file);
  ASSERT_EQ(a.code, 0) << a.err;
  EXPECT_TRUE(has(text_of(file), "sample = \"60.0013 s\"")) << text_of(file);
  EXPECT_EQ(driftscope("check " + file).code, 0);
  EXPECT_EQ(driftscope("identify " + file + " " + own + " --quiet").code, 0);
}

}  // namespace
}  // namespace drift::new_study_log_test
