// What accelerometers and gimbals of a log tell together before a study is made of it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/base/units.hpp"
#include "core/recording/recording.hpp"
#include "tests/support/log_edits.hpp"
#include "tests/support/program.hpp"
#include "tests/support/short_study.hpp"

namespace drift::attitudes_of_a_log_test {
namespace {

using namespace drift::test;

TEST(AttitudesOfALog, AxesAreThoseOfTheSecondRowWhereTheFirstIsOfThePositionBefore) {
  const ScratchFolder folder;
  const std::string made = folder.write("made.toml", short_study), own = folder.file("own.csv");
  ASSERT_EQ(driftscope("simulate " + made + " -o " + own).code, 0);
  const auto axes = [&](const std::string& name) {
    EXPECT_EQ(driftscope("new diagnose " + own + " -o " + folder.file(name)).code, 0);
    std::istringstream lines(text_of(folder.file(name)));
    std::string all, line;
    while (std::getline(lines, line))
      if (line.starts_with("axes")) all += line + "\n";
    return all;
  };
  const std::string right = axes("right.toml");
  std::istringstream lines(text_of(own));
  std::vector<std::string> rows;
  for (std::string line; std::getline(lines, line);) rows.push_back(line);
  const auto cell = [](const std::string& row, std::size_t k) {
    std::size_t from = 0;
    while (k-- > 0) from = row.find(',', from) + 1;
    return std::pair{from, row.find(',', from)};
  };
  std::size_t column = 0;
  for (const std::string& row : rows)
    if (row.find("position") != std::string::npos && row.find("acc_x") != std::string::npos) {
      const auto at = row.find("position");
      column = static_cast<std::size_t>(
          std::count(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(at), ','));
    }
  std::string early;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::string row = rows[i];
    const bool numbered = !row.empty() && std::isdigit(static_cast<unsigned char>(row[0])) != 0;
    if (numbered && i + 1 < rows.size()) {
      const auto [from, to] = cell(row, column);
      const auto [next, end] = cell(rows[i + 1], column);
      row.replace(from, to - from, rows[i + 1].substr(next, end - next));
    }
    early += row + "\n";
  }
  folder.write("own.csv", early);
  EXPECT_EQ(axes("early.toml"), right);
  const auto fit = driftscope("identify " + folder.file("early.toml") + " " + own);
  EXPECT_EQ(fit.code, 4);
  EXPECT_TRUE(fit.err.find("the numbers of the positions change a row early") != std::string::npos)
      << fit.err;
}

TEST(AttitudesOfALog, TheUnitOfGimbalAnglesIsThatInWhichTheyHaveUpAsTheAccelerometersHaveIt) {
  constexpr std::pair<const char*, double> units[] = {{"deg", 1.0},
                                                      {"rad", detail::deg},
                                                      {"gon", 1.0 / 0.9},
                                                      {"mrad", 1e3 * detail::deg},
                                                      {"arcmin", 60.0}};
  const ScratchFolder folder;
  const std::string study = folder.write("study.toml", short_study), made = folder.file("made.csv");
  ASSERT_EQ(driftscope("simulate '" + study + "' -o '" + made + "'").code, 0);
  const Recording r = read_recording(made, RecordingKind::platform, 9.81);
  for (const auto& [unit, per_degree] : units) {
    const double size = per_degree;  // a lambda of C++20 by clang 14 has no structured binding
    std::string out = "Zeit_s;Lage;Bx [g];By [g];Bz [g];phi_aussen;phi_mitte;phi_innen\n";
    for (std::size_t i = 0; i < r.rows(); ++i) {
      const auto at = [&](const char* name) { return r.find(name)->values[i]; };
      const bool read = size != 60.0 || i % 11 != 5;  // else what a logger writes that has not
      const auto gimbal = [&](const char* name) {
        return read ? size / detail::deg * at(name) : 9999.999;
      };
      out += fmt::format("{};{};{:.9f};{:.9f};{:.9f};{:.9f};{:.9f};{:.9f}\n", at("time"),
                         at("position"), at("acc_x"), at("acc_y"), at("acc_z"),
                         gimbal("gimbal_outer"), gimbal("gimbal_middle"), gimbal("gimbal_inner"));
    }
    const std::string log = folder.write(std::string(unit) + ".csv", out),
                      lab = folder.file(std::string(unit) + ".toml");
    ASSERT_EQ(driftscope("new diagnose '" + log + "' -o '" + lab + "'").code, 0);
    const std::string text = text_of(lab);
    EXPECT_NE(text.find(fmt::format("gimbal_outer = \"phi_aussen [{}]\"", unit)), std::string::npos)
        << text;
    EXPECT_EQ(text.find(fmt::format("in [{}], where they have Up", unit)) == std::string::npos,
              std::string(unit) == "deg")
        << text;
    const auto fit = driftscope("identify '" + lab + "' '" + log + "' --quiet");
    EXPECT_EQ(fit.code, 0) << fit.err;
  }
}

/// A number that is late or early by rows: attitude and heading are those of the middle.
TEST(AttitudesOfALog, RowsOfAnotherPositionAtEitherEndChangeNoAttitude) {
  const ScratchFolder folder;
  const std::string made = folder.write("made.toml", short_study), own = folder.file("own.csv");
  ASSERT_EQ(driftscope("simulate " + made + " -o " + own).code, 0);
  const std::string text = text_of(own);
  std::vector<std::string> was;
  with_column(text, "position", [&](const std::string& cell) {
    was.push_back(cell);
    return cell;
  });
  const auto attitudes = [&](std::ptrdiff_t late) {
    std::ptrdiff_t row = 0;
    folder.write("late.csv", with_column(text, "position", [&](const std::string&) {
                   const std::ptrdiff_t from = row++ - late, last = std::ssize(was) - 1;
                   return was[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(from, 0, last))];
                 }));
    const std::string file = folder.file(fmt::format("late{}.toml", late));
    EXPECT_EQ(driftscope("new platform " + folder.file("late.csv") + " -o " + file).code, 0);
    std::string lines;
    std::istringstream study(text_of(file));
    for (std::string line; std::getline(study, line);)
      if (line.starts_with("axes") || line.starts_with("case_heading")) lines += line + "\n";
    return lines;
  };
  const std::string right = attitudes(0);
  EXPECT_TRUE(has(right, "case_heading")) << right;
  for (const int late : {-2, -1, 1, 2}) EXPECT_EQ(attitudes(late), right) << late;
}

TEST(AttitudesOfALog, OfATumbleAreDirectionsAndTurns) {
  std::string plan;
  for (int k = 0; k < 12; ++k)
    plan += fmt::format("[[plan.position]]\naxes = \"x=N y=W z=U\"\nturn = \"{} deg about y\"\n",
                        30 * k);
  const ScratchFolder folder;
  const std::string made = folder.write("made.toml",
                                        replaced(replaced(short_study, "preset = \"six\"\n", ""),
                                                 "[readout]", plan + "[readout]")),
                    own = folder.file("own.csv"), file = folder.file("lab.toml");
  ASSERT_EQ(driftscope("simulate " + made + " -o " + own).code, 0);
  ASSERT_EQ(driftscope("new platform " + own + " -o " + file).code, 0);
  const std::string study = text_of(file);
  EXPECT_TRUE(has(study, "axes  = \"x=N y=W z=U\"\nturn  = \"30 deg about y\"\n")) << study;
  EXPECT_TRUE(has(study, "axes  = \"x=D y=W z=N\"\nturn  = \"-30 deg about y\"\n")) << study;
  EXPECT_TRUE(has(study, "# The axes are those that the gimbal angles show")) << study;
  const Answer table = driftscope("check " + made);
  EXPECT_TRUE(has(table.out, "x=N y=W z=U, 330 deg about y  ")) << table.out;
  EXPECT_EQ(driftscope("identify " + file + " " + own + " --quiet").code, 0);
}

}  // namespace
}  // namespace drift::attitudes_of_a_log_test
