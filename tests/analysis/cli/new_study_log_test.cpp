// `driftscope new` with logs whose columns need a closer look.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "tests/support/log_edits.hpp"
#include "tests/support/program.hpp"
#include "tests/support/short_study.hpp"

namespace drift::new_study_log_test {
namespace {

using namespace drift::test;

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

TEST(NewStudy, EveryPositionHasTheSampleAndTheDwellItWasRecordedWith) {
  const ScratchFolder folder;
  const std::string positions =
      "[[plan.position]]\naxes = \"x=N y=W z=U\"\ndwell = \"20 min\"\nsample = \"300 s\"\n"
      "[[plan.position]]\naxes = \"x=U y=N z=W\"\ndwell = \"30 min\"\n"
      "[[plan.position]]\naxes = \"x=W y=U z=N\"\ndwell = \"10 min\"\nsample = \"100 s\"\n";
  const std::string made =
      folder.write("made.toml", replaced(replaced(replaced(short_study, "preset = \"six\"\n", ""),
                                                  "dwell  = \"10 min\"\n", ""),
                                         "[readout]", positions + "[readout]"));
  const std::string own = folder.file("own.csv"), file = folder.file("lab.toml");
  ASSERT_EQ(driftscope("simulate " + made + " -o " + own).code, 0);
  ASSERT_EQ(driftscope("new platform " + own + " -o " + file).code, 0);
  const std::string study = text_of(file);
  for (const char* part :
       {"sample = \"60 s\"      # of the recording", "dwell = \"1200 s\"\nsample = \"300 s\"\n",
        "dwell = \"1800 s\"\n[[plan.position]]", "dwell = \"600 s\"\nsample = \"100 s\"\n"})
    EXPECT_TRUE(has(study, part)) << part << study;
  EXPECT_EQ(driftscope("check " + file).code, 0);
  const std::string looked = driftscope("look " + own).out;
  EXPECT_TRUE(has(looked, "gaps none; between positions none")) << looked;
  EXPECT_TRUE(has(looked, "1200         1200          300\n")) << looked;
  EXPECT_TRUE(has(looked, "3600          600          100\n")) << looked;
  // In a sweep all dwells are alike, in samples that are.
  const std::string sweep = folder.file("sweep.toml");
  ASSERT_EQ(driftscope("new sweep " + own + " -o " + sweep).code, 0);
  EXPECT_FALSE(has(text_of(sweep), "300 s")) << text_of(sweep);
  EXPECT_EQ(driftscope("check " + sweep).code, 0);
}

TEST(NewStudy, TakesTheNoiseThatTheRestsShow) {
  const ScratchFolder folder;
  const std::string made = folder.write("made.toml", replaced(short_study, "10 min", "60 min")),
                    own = folder.file("own.csv"), file = folder.file("lab.toml");
  ASSERT_EQ(driftscope("simulate " + made + " -o " + own).code, 0);
  ASSERT_EQ(driftscope("new diagnose " + own + " -o " + file).code, 0);
  const std::string study = text_of(file);
  EXPECT_TRUE(has(study, ", as the rests of the recording show\n")) << study;
  EXPECT_EQ(driftscope("check " + file).code, 0);
}

TEST(NewStudy, APositionThatIsNotInTheLogIsNotInItsPlan) {
  const ScratchFolder folder;
  const std::string made = folder.write("made.toml", short_study), own = folder.file("own.csv"),
                    file = folder.file("lab.toml");
  ASSERT_EQ(driftscope("simulate " + made + " -o " + own).code, 0);
  folder.write("own.csv", with_column(text_of(own), "position", [](const std::string& cell) {
                 return std::to_string(std::stoi(cell) + (cell > "3" ? 1 : 0));
               }));
  ASSERT_EQ(driftscope("new diagnose " + own + " -o " + file).code, 0);
  const std::string study = text_of(file);
  EXPECT_TRUE(has(study, R"("3" = 3, "5" = 4, "6" = 5)")) << study;
  const Answer fit = driftscope("identify " + file + " " + own + " --quiet");
  EXPECT_EQ(fit.code, 0) << fit.err;
}

TEST(NewStudy, PositionsOfDaysAreAskedAbout) {
  const ScratchFolder folder;
  const std::string made = folder.write("made.toml", short_study), own = folder.file("own.csv");
  ASSERT_EQ(driftscope("simulate " + made + " -o " + own).code, 0);
  const auto says = [&](const std::string& file) {
    const Answer a = driftscope("new diagnose " + own + " -o " + folder.file(file));
    return has(a.out + a.err, "is their unit right?");
  };
  EXPECT_FALSE(says("a.toml"));
  // Milliseconds under a name that says s; without commands the platform may be held.
  std::string text = with_column(text_of(own), "time [s]", [](const std::string& cell) {
    return fmt::format("{:.0f}", 1000.0 * std::stod(cell));
  });
  for (const std::string axis : {"x", "y", "z"}) text = replaced(text, "cmd_" + axis, "no_" + axis);
  folder.write("own.csv", text);
  EXPECT_TRUE(says("b.toml"));
}

TEST(NewStudy, ADropoutIsNotTheNoise) {
  const ScratchFolder folder;
  const std::string made = folder.write("made.toml", replaced(short_study, "10 min", "60 min")),
                    own = folder.file("own.csv"), file = folder.file("lab.toml");
  ASSERT_EQ(driftscope("simulate " + made + " -o " + own).code, 0);
  int row = 0;
  folder.write("own.csv", with_column(text_of(own), "acc_x [g]", [&](const std::string& cell) {
                 return ++row == 100 ? "0" : cell;
               }));
  ASSERT_EQ(driftscope("new diagnose " + own + " -o " + file).code, 0);
  const std::string study = text_of(file);
  EXPECT_TRUE(has(study, "as the rests of the recording show without 1 isolated sample")) << study;
  const auto at = study.find("accelerometer_noise = \"") + 23;
  EXPECT_NEAR(std::stod(study.substr(at)), 5.0, 0.5) << study;  // 3 x 360 samples: 0.1
}

TEST(NewStudy, TakesLatitudeAndGravityFromAboveTheHeaderAndPositionsFromTheirNumbers) {
  const ScratchFolder folder;
  const std::string made = folder.write("made.toml", short_study), own = folder.file("own.csv"),
                    file = folder.file("lab.toml");
  ASSERT_EQ(driftscope("simulate " + made + " -o " + own).code, 0);
  std::string text = with_column(text_of(own), "position", [](const std::string& cell) {
    return std::to_string(70 - 10 * std::stoi(cell));
  });
  while (text.starts_with("#")) text.erase(0, text.find('\n') + 1);
  text = replaced(text, "position", "Versuch");
  folder.write("own.csv", "Labor 3\nBreite: 45,75\ng = 9.8065 m/s^2\n" + text);
  const Answer a = driftscope("new diagnose " + own + " -o " + file);
  ASSERT_EQ(a.code, 0) << a.err;
  const std::string study = text_of(file);
  EXPECT_TRUE(has(study, "latitude = \"45.75 deg\"")) << study;
  EXPECT_TRUE(has(study, "own.csv:2)")) << study;
  EXPECT_TRUE(has(study, "gravity  = \"9.8065 m/s^2\"")) << study;
  EXPECT_TRUE(has(study, "own.csv:3)")) << study;
  EXPECT_TRUE(has(study, "position = \"Versuch\"")) << study;
  EXPECT_TRUE(has(study, "as it scatters in the rests")) << study;  // too short for a card
  EXPECT_TRUE(has(study, "positions = { \"60\" = 1, \"50\" = 2")) << study;
  const Answer same = driftscope("identify " + file + " " + own),
               other = driftscope("identify " + file + " " + own +
                                  " --set site.latitude='\"45.95 deg\"'");
  EXPECT_EQ(same.code, 0) << same.err;
  EXPECT_FALSE(has(same.err, "says latitude")) << same.err;
  EXPECT_TRUE(has(other.err, "own.csv:2: says latitude 45.75 deg, the study 45.95 deg"))
      << other.err;
  folder.write("own.csv", "Labor 3\nBreite: 45 mm\n" + text);
  ASSERT_EQ(driftscope("new diagnose " + own + " -o " + folder.file("b.toml")).code, 0);
  EXPECT_TRUE(has(text_of(folder.file("b.toml")), "latitude = \"45 deg\""));
  EXPECT_TRUE(has(text_of(folder.file("b.toml")), "of the laboratory: check"));
  // Until somebody says that it is right, every look at the study and every answer by it says so.
  const std::string b = folder.file("b.toml"),
                    by = "line 6: latitude = \"45 deg\" (of the laboratory)";
  EXPECT_TRUE(has(driftscope("check " + b).err, by));
  EXPECT_TRUE(has(driftscope("identify " + b + " " + own).err, by));
  EXPECT_FALSE(has(driftscope("check " + b + " --set site.latitude='\"46 deg\"'").err, by));
  const std::string guessed = text_of(b);
  folder.write("b.toml", replaced(guessed, "of the laboratory: check", "of the laboratory :Check"));
  EXPECT_TRUE(has(driftscope("check " + b).err, by)) << "however it is spelt";
  folder.write("b.toml", replaced(guessed, "of the laboratory: check", "of the laboratory"));
  EXPECT_FALSE(has(driftscope("check " + b).err, by));
}

TEST(NewStudy, ACopiedPositionIsTheFirstThingThatIsSaidOfALog) {
  const ScratchFolder folder;
  const std::string made = folder.write("made.toml", short_study), own = folder.file("own.csv");
  ASSERT_EQ(driftscope("simulate " + made + " -o " + own).code, 0);
  std::vector<std::string> before;  // of the second position
  std::istringstream lines(text_of(own));
  std::string text, line;
  std::ptrdiff_t position = -1, acc = -1;
  std::size_t row = 0;
  while (std::getline(lines, line)) {
    std::vector<std::string> cells;
    std::istringstream cut(line);
    for (std::string cell; std::getline(cut, cell, ',');) cells.push_back(cell);
    if (position < 0) {
      const auto it = std::ranges::find(cells, "position");
      if (it != cells.end()) position = it - cells.begin();
      acc = std::ranges::find(cells, "acc_x [g]") - cells.begin();
    } else if (cells[static_cast<std::size_t>(position)] == "2") {
      for (std::ptrdiff_t a = acc; a < acc + 3; ++a)
        before.push_back(cells[static_cast<std::size_t>(a)]);
    } else if (cells[static_cast<std::size_t>(position)] == "4" && row + 3 <= before.size()) {
      for (std::ptrdiff_t a = acc; a < acc + 3; ++a)
        cells[static_cast<std::size_t>(a)] = before[row++];
    }
    for (std::size_t i = 0; i < cells.size(); ++i) text += (i > 0 ? "," : "") + cells[i];
    text += "\n";
  }
  ASSERT_GE(row, 24u);
  folder.write("own.csv", text);
  const Answer looked = driftscope("look " + own);
  EXPECT_TRUE(has(looked.out, "number for number: copied into the log by mistake?")) << looked.out;
  const Answer read = driftscope("identify " + made + " " + own);
  const auto first = read.err.find("note: ");
  ASSERT_NE(first, std::string::npos) << read.err;
  EXPECT_TRUE(has(read.err.substr(first, read.err.find('\n', first) - first),
                  "number for number: copied into the log by mistake?"))
      << read.err;
}

/// Six positions of a real platform, whose accelerometers are as their priors say, at 45 deg.
std::string turned_study() {
  std::string text =
      "schema = 1\n[site]\nlatitude = \"45.75 deg\"\n[plan]\nmode = \"free\"\nsample = \"60 s\"\n";
  for (const char* axes :
       {"x=N y=W z=U", "x=N y=D z=W", "x=U y=N z=W", "x=D y=S z=W", "x=S y=U z=W", "x=N y=E z=D"})
    text += fmt::format(
        "[[plan.position]]\naxes = \"{}\"\ndwell = \"30 min\"\ncase_heading = \"45 deg\"\n", axes);
  return text +
         "[truth]\ncoupling = \"eq5\"\nterms = [\"fixed_drift\", \"g_drift\", "
         "\"gyro_misalignment\", \"accelerometer\"]\n[[filter]]\nname = \"eq5\"\n"
         "coupling = \"eq5\"\n";
}

/// A study with the axes of misread gimbals would have the accelerometers seem wrong.
TEST(NewStudy, GimbalsAndAccelerometersThatShowTwoUpsAreAContradiction) {
  const ScratchFolder folder;
  const std::string made = folder.write("made.toml", short_study), own = folder.file("own.csv");
  ASSERT_EQ(driftscope("simulate " + made + " -o " + own).code, 0);
  std::string text = text_of(own);
  while (text.starts_with("#")) text.erase(0, text.find('\n') + 1);
  int made_studies = 0;
  const auto told = [&](const std::string& log) {
    const std::string file = folder.file(fmt::format("lab{}.toml", made_studies++));
    folder.write("own.csv", log);
    const Answer a = driftscope("new diagnose " + own + " -o " + file);
    EXPECT_EQ(a.code, 0) << a.err;
    const bool from_gimbals = has(text_of(file), "# The axes are those that the gimbal angles");
    std::string out = (from_gimbals ? "gimbals: " : "accelerometers: ") + a.out;
    std::ranges::replace(out, '\n', ' ');
    return out;
  };
  EXPECT_TRUE(has(told(text), "gimbals: ")) << told(text);
  EXPECT_FALSE(has(told(text), "two different Ups"));
  const std::string turned = told(with_column(text, "gimbal_inner [deg]", [](const auto& cell) {
    return fmt::format("{}", std::stod(cell) + 90.0);
  }));
  EXPECT_TRUE(has(turned, "accelerometers: ")) << turned;
  EXPECT_TRUE(has(turned, "two different Ups in")) << turned;
  EXPECT_TRUE(has(turned, "offset = { gimbal_inner = \"-90 deg\" }")) << turned;
  for (const char* name : {"gimbal_outer", "gimbal_middle", "gimbal_inner"})
    text = replaced(text, fmt::format("{} [deg]", name), fmt::format("{} [rad]", name));
  EXPECT_TRUE(has(told(text), "the gimbal angles are [deg], not [rad]")) << told(text);
}

TEST(NewStudy, OfARealPlatformItsGuessedHeadingsAreDoubtedAndNoEffectIsAdded) {
  const ScratchFolder folder;
  const std::string made = folder.write("made.toml", turned_study()), own = folder.file("own.csv"),
                    file = folder.file("lab.toml");
  ASSERT_EQ(driftscope("simulate " + made + " -o " + own).code, 0);
  folder.write("own.csv",
               "Latitude: 45.75\n" + replaced(text_of(own), "case_heading [deg]", "note"));
  ASSERT_EQ(driftscope("new diagnose " + own + " -o " + file).code, 0);
  EXPECT_TRUE(has(text_of(file), "\"accelerometer\"]")) << text_of(file);
  const Answer told = driftscope("diagnose " + file + " " + own + " -o " + folder.file("out"));
  EXPECT_TRUE(has(told.out, "Verdict wrong headings: ")) << told.out << told.err;
}

}  // namespace
}  // namespace drift::new_study_log_test
