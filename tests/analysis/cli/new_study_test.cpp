// `driftscope new`: what it writes is a study that the other commands take.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <tuple>

#include "core/base/check.hpp"
#include "tests/support/program.hpp"
#include "tests/support/short_study.hpp"

namespace drift::new_study_test {
namespace {

using namespace drift::test;

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(NewStudy, EveryKindIsValid) {
  const ScratchFolder folder;
  for (const std::string kind : {"platform", "strapdown", "study", "sweep", "diagnose"}) {
    const std::string file = folder.file(kind + ".toml");
    const Answer made = driftscope("new " + kind + " -o " + file);
    EXPECT_EQ(made.code, 0) << made.err;
    const Answer checked = driftscope("check " + file);
    EXPECT_EQ(checked.code, 0) << kind << "\n" << checked.err;
    EXPECT_EQ(has(checked.out, "sweep."), kind == "sweep");
    EXPECT_EQ(has(text_of(file), "another may fit as well: `driftscope diagnose` tells"),
              kind == "diagnose");
  }
  EXPECT_EQ(driftscope("new poem -o " + folder.file("p.toml")).code,
            static_cast<int>(ExitCode::usage));
}

TEST(NewStudy, OfAUnitOnACaseSaysWhereAccelerometersAreReadInTurns) {
  const ScratchFolder folder;
  const std::string file = folder.file("case.toml"), key = "accelerometers_in_turns = true";
  ASSERT_EQ(driftscope("new strapdown -o " + file).code, 0);
  std::string text = text_of(file);
  const auto at = text.find("# " + key);
  ASSERT_NE(at, std::string::npos) << text;
  text.erase(at, 2);
  for (const auto& [study, value] :
       {std::pair{file, "false"}, {folder.write("read.toml", text), "true"}}) {
    const Answer checked = driftscope("check " + study);
    const std::string row = "plan.accelerometers_in_turns";
    const auto line = checked.out.find(row);
    ASSERT_NE(line, std::string::npos) << checked.out << checked.err;
    EXPECT_TRUE(has(checked.out.substr(line, checked.out.find('\n', line) - line), value));
  }
}

TEST(NewStudy, APlanIsFilledFromTheRecording) {
  const ScratchFolder folder;
  const std::string made = folder.write("made.toml", short_study);
  const std::string recording = folder.file("r.csv"), file = folder.file("lab.toml");
  ASSERT_EQ(driftscope("simulate " + made + " -o " + recording).code, 0);
  const Answer a = driftscope("new diagnose " + recording + " -o " + file);
  ASSERT_EQ(a.code, 0) << a.err;
  const std::string checked = driftscope("check " + file).out;
  EXPECT_TRUE(has(checked, "plan.position.position 6.dwell"));
  EXPECT_FALSE(has(checked, "plan.position.position 7."));
  const std::string text = text_of(file);
  EXPECT_TRUE(has(text, "sample = \"60 s\"")) << text;
  EXPECT_TRUE(has(text, "dwell = \"600 s\"")) << text;
  // The plan six holds each axis up and down once.
  for (const std::string axis : {"x", "y", "z"})
    for (const std::string way : {"U", "D"}) EXPECT_TRUE(has(text, axis + "=" + way)) << text;
  EXPECT_EQ(driftscope("identify " + file + " " + recording + " --quiet").code, 0);
}

TEST(NewStudy, AttitudesEntriesHeadingsAndLawAreThoseOfTheRecording) {
  const ScratchFolder folder;
  const std::string recording = folder.file("r.csv"), file = folder.file("lab.toml");
  ASSERT_EQ(driftscope("simulate " + test::config("table1.toml") + " -o " + recording).code, 0);
  ASSERT_EQ(driftscope("new platform " + recording + " -o " + file).code, 0);
  const std::string text = text_of(file),
                    made = text_of(std::string(DRIFT_SOURCE_DIR) + "/configs/table1.toml");
  const auto axes_in = [](const std::string& study) {
    std::vector<std::string> all;
    for (std::size_t at = 0; (at = study.find("\"x=", at)) != std::string::npos; ++at)
      all.push_back(study.substr(at, study.find('"', at + 1) - at));
    return all;
  };
  EXPECT_EQ(axes_in(text), axes_in(made));
  EXPECT_TRUE(has(text, "entry = \"torqued\"\ncase_heading = \"360 deg\"")) << text;
  EXPECT_TRUE(has(text, "mode   = \"free\"")) << text;
  EXPECT_EQ(driftscope("identify " + file + " " + recording + " --quiet").code, 0);
}

TEST(NewStudy, ALawOfItsOwnStandsWithThePosition) {
  const ScratchFolder folder;
  const std::string recording = folder.file("r.csv"), file = folder.file("lab.toml");
  std::string plan =
      "schema = 1\n[site]\nlatitude = \"45.75 deg\"\n[plan]\nmode = \"level\"\n"
      "dwell = \"10 min\"\nsample = \"60 s\"\n";
  for (const std::string position : {"x=N y=W z=U", "x=U y=S z=E", "x=W y=N z=D", "x=D y=N z=E"})
    plan += "[[plan.position]]\nname = \"" + position + "\"\naxes = \"" + position + "\"\n" +
            (position == "x=W y=N z=D" ? "mode = \"free\"\n" : "");
  plan += "[truth]\ncoupling = \"eq5\"\n[[filter]]\nname = \"f\"\ncoupling = \"eq5\"\n";
  ASSERT_EQ(driftscope("simulate " + folder.write("own.toml", plan) + " -o " + recording).code, 0);
  ASSERT_EQ(driftscope("new platform " + recording + " -o " + file).code, 0);
  const std::string text = text_of(file);
  EXPECT_TRUE(has(text, "mode   = \"level\"")) << text;
  const auto third = text.find("name  = \"position 3\""), own = text.find("mode  = \"free\"");
  EXPECT_TRUE(own > third && own < text.find("name  = \"position 4\"")) << text;
  EXPECT_EQ(own, text.rfind("mode  = ")) << text;
  const Answer a = driftscope("identify " + file + " " + recording);
  EXPECT_FALSE(has(a.out + a.err, "correct plan.mode")) << a.out << a.err;
}

TEST(NewStudy, WhatNoColumnTellsIsLeftBlankAndSaid) {
  const ScratchFolder folder;
  const std::string made = folder.write("made.toml", short_study), own = folder.file("own.csv"),
                    file = folder.file("lab.toml");
  ASSERT_EQ(driftscope("simulate " + made + " -o " + own).code, 0);
  std::string text = text_of(own);
  const auto rename = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  rename("time [s]", "Stoppuhr");
  rename("cmd_x [deg/h]", "cmd_x");
  folder.write("own.csv", text);
  const Answer a = driftscope("new diagnose " + own + " -o " + file);
  ASSERT_EQ(a.code, 0) << a.err;
  EXPECT_TRUE(has(a.out, "time = \"COLUMN [s]\"")) << a.out;
  std::string study = text_of(file);
  EXPECT_TRUE(has(study, "cmd_x = \"cmd_x [?]\"")) << study;
  EXPECT_TRUE(has(study, "# ")) << study;
  const Answer open = driftscope("check " + file);
  EXPECT_NE(open.code, 0);
  EXPECT_TRUE(has(open.err, "unknown unit '?'")) << open.err;
  // Filled in, it is read, and what is said next gives the plan.
  study.replace(study.find("[?]"), 3, "[deg/h]");
  study.replace(study.find("columns = { "), 12, "columns = { time = \"Stoppuhr [s]\", ");
  study.replace(study.find("\"45 deg\""), 8, "\"48.137 deg\"");
  study.replace(study.find("9.80665 m/s^2"), 13, "9.80733 m/s^2");
  folder.write("lab.toml", study);
  const std::string read = folder.file("read.csv"), next = folder.file("next.toml");
  const Answer converted = driftscope("convert " + file + " " + own + " -o " + read);
  ASSERT_EQ(converted.code, 0) << converted.err;
  ASSERT_EQ(driftscope("new diagnose " + read + " -o " + next).code, 0);
  EXPECT_EQ(driftscope("identify " + next + " " + read + " --quiet").code, 0);
  const std::string again = text_of(next);
  EXPECT_TRUE(has(again, "latitude = \"48.137 deg\"")) << again;
  EXPECT_TRUE(has(again, "gravity  = \"9.80733 m/s^2\"")) << again;
}

/// What stands before the first of two texts and after it.
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(NewStudy, ColumnsThatHaveNoPlaceAreSaidWithTheLineToWrite) {
  const ScratchFolder folder;
  const std::string made = folder.write("made.toml", short_study), own = folder.file("own.csv");
  ASSERT_EQ(driftscope("simulate " + made + " -o " + own).code, 0);
  std::string text = text_of(own);
  for (const auto& [from, to] : {std::pair{"gimbal_outer [deg]", "Kanal 7 [deg]"},
                                 {"gimbal_middle [deg]", "Kanal 8 [deg]"},
                                 {"gimbal_inner [deg]", "Kanal 9 [deg]"},
                                 {"cmd_x [deg/h]", "U_bat [V]"}})
    text = replaced(text, from, to);
  for (const std::string axis : {"y", "z"})  // commands are three or none
    text = replaced(text, "cmd_" + axis + " [deg/h]", "I_" + axis + " [A]");
  folder.write("own.csv", text);
  const std::string file = folder.file("lab.toml");
  const Answer a = driftscope("new diagnose " + own + " -o " + file);
  ASSERT_EQ(a.code, 0) << a.err;
  std::string said = a.out;
  for (std::size_t at = 0; (at = said.find('\n', at)) != std::string::npos;) said[at] = ' ';
  for (const char* part :
       {"No column seems to be gimbal angles", "gimbal_outer = \"Kanal 7 [deg]\"",
        "gimbal_inner = \"Kanal 9 [deg]\"", "check which is which", "ignore = [", "\"U_bat\""})
    EXPECT_TRUE(has(said, part)) << part << "\n" << a.out;
  EXPECT_TRUE(has(text_of(file), "# No column seems to be gimbal angles")) << text_of(file);
  EXPECT_EQ(driftscope("check " + file).code, 0);
  // The line that was proposed is the one that reads them.
  const std::string study =
      text_of(file) +
      "\n[recording]\ncolumns = { gimbal_outer = \"Kanal 7 [deg]\", gimbal_middle = \"Kanal 8 "
      "[deg]\", gimbal_inner = \"Kanal 9 [deg]\" }\n";
  const std::string out = folder.file("read.csv");
  const Answer converted =
      driftscope("convert " + folder.write("full.toml", study) + " " + own + " -o " + out);
  EXPECT_EQ(converted.code, 0) << converted.err;
  EXPECT_TRUE(has(text_of(out), "gimbal_inner [deg]"));
}

TEST(NewStudy, ALogOfTheOtherKindOfUnitIsRefusedWithTheCommandThatFits) {
  const ScratchFolder folder;
  std::string platform = "Zeit [s],Lage,ax [g],ay [g],az [g],phi_a [deg],phi_m [deg],phi_i [deg]\n",
              on_case = "t [s],ax [g],ay [g],az [g],wx [deg/s],wy [deg/s],wz [deg/s]\n";
  for (int i = 0; i < 20; ++i) {
    platform += fmt::format("{},Lage {},0.0{},0,1,1,2,3\n", 60 * (i + 1), 1 + i / 10, i % 10);
    on_case += fmt::format("{},0.0{},0,1,0.1,0.2,0.{}\n", 0.1 * (i + 1), i % 10, i % 7);
  }
  const std::string file = folder.file("lab.toml");
  for (const auto& [kind, log, says] :
       {std::tuple{"strapdown", platform, "driftscope new platform"},
        {"diagnose", on_case, "driftscope new strapdown"}}) {
    const Answer a =
        driftscope(std::string("new ") + kind + " " + folder.write("log.csv", log) + " -o " + file);
    EXPECT_EQ(a.code, recording_error) << a.out;
    EXPECT_TRUE(has(a.err, says)) << a.err;
    EXPECT_FALSE(std::filesystem::exists(file));
  }
  // With gyros beside the gimbals it may be either; names of positions have no place on a case.
  std::string rows = "t [s],Lage,ax [g],ay [g],az [g],wx [deg/s],wy [deg/s],wz [deg/s]\n";
  for (int i = 0; i < 20; ++i)
    rows += fmt::format("{},L{},0.0{},0,1,0.1,0.2,0.{}\n", 0.1 * (i + 1), i / 10, i % 10, i % 7);
  const Answer a = driftscope("new strapdown " + folder.write("log.csv", rows) + " -o " + file);
  ASSERT_EQ(a.code, 0) << a.err;
  const Answer checked = driftscope("check " + file);
  EXPECT_EQ(checked.code, 0) << checked.err << text_of(file);
}

TEST(NewStudy, AsManyPositionsAsARecordingNamesThatCannotBeReadYet) {
  const ScratchFolder folder;
  std::string log = "Zeit [s],Lage,ax [g],ay [g],az [g],phi_a,phi_m,phi_i\n";
  for (int i = 0; i < 24; ++i) log += fmt::format("{},L{},0,0,1,1,2,3\n", 60 * (i + 1), i / 2);
  const std::string file = folder.file("lab.toml");
  const Answer a = driftscope("new diagnose " + folder.write("log.csv", log) + " -o " + file);
  ASSERT_EQ(a.code, 0) << a.err;
  std::string study = text_of(file);
  ASSERT_TRUE(has(study, "[?]")) << study;
  for (std::size_t at = 0; (at = study.find("[?]", at)) != std::string::npos;)
    study.replace(at, 3, "[deg]");
  const Answer checked = driftscope("check " + folder.write("full.toml", study));
  EXPECT_EQ(checked.code, 0) << checked.err << study;
}

TEST(NewStudy, TimeAndTemperatureAreToldByTheirUnitsAndPositionsByTheirTexts) {
  const ScratchFolder folder;
  std::string rows = "Stoppuhr [ms],Stato,Kern [\u00B0C],U [V]\n";
  for (int i = 0; i < 6; ++i)
    rows += fmt::format("{},x {},21.{},5\n", 60000 * (i + 1), i < 3 ? "up" : "down", i);
  const auto look = driftscope("look '" + folder.write("log.csv", rows) + "'");
  EXPECT_NE(look.out.find("time = \"Stoppuhr [ms]\""), std::string::npos) << look.out;
  EXPECT_NE(look.out.find("temperature = \"Kern [\u00B0C]\""), std::string::npos) << look.out;
  EXPECT_NE(look.out.find("position = \"Stato\""), std::string::npos) << look.out;
  EXPECT_NE(look.out.find("\"x down\" = 2"), std::string::npos) << look.out;
  const auto two = driftscope("look '" + folder.write("two.csv", "A [ms],B [s]\n1,2\n2,3\n") + "'");
  EXPECT_EQ(two.out.find("time = \"A"), std::string::npos) << two.out;
}

TEST(NewStudy, AClockOfNumbersThatBeginsAgainAtMidnightIsProposedAsTheCounterThatItIs) {
  const ScratchFolder folder;
  for (const auto& [unit, per_s, tick, period] :
       {std::tuple{"ms", 1e3, "1 ms", 86400.0}, std::tuple{"s", 1.0, "1 s", 86400.0},
        std::tuple{"s", 1.0, "1 s", 604800.0}}) {  // of a week, as of GPS
    std::string rows = fmt::format("Uhr [{}],Lage,ax [g],ay [g],az [g]\n", unit);
    for (int i = 0; i < 20; ++i)
      rows +=
          fmt::format("{:.1f},{},0.0{},0,1\n", std::fmod(period - 300.0 + 60.0 * i, period) * per_s,
                      i < 10 ? 1 : 2, i % 10);
    const auto look = driftscope("look '" + folder.write("log.csv", rows) + "'");
    ASSERT_EQ(look.code, 0) << look.err;
    EXPECT_TRUE(has(look.out, "counter = \"Uhr\"")) << look.out;
    EXPECT_TRUE(has(look.out, std::string("tick    = \"") + tick + "\"")) << look.out;
    EXPECT_TRUE(has(look.out, fmt::format("wrap    = {:.0f}", period * per_s))) << look.out;
    EXPECT_FALSE(has(look.out, "time = ")) << look.out;
    EXPECT_FALSE(has(look.out, "not a recording yet")) << look.out;
  }
}

TEST(NewStudy, NoFileOfTheUsersIsReplaced) {
  const ScratchFolder folder;
  const std::string mine = folder.write("mine.toml", "# mine\n");
  EXPECT_NE(driftscope("new study -o " + mine).code, 0);
  EXPECT_EQ(text_of(mine), "# mine\n");
}

}  // namespace
}  // namespace drift::new_study_test
