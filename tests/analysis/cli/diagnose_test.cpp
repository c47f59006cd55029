// `driftscope diagnose` as a user runs it.
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/check.hpp"
#include "core/recording/recording.hpp"
#include "tests/support/program.hpp"
#include "tests/support/strapdown_recording.hpp"

namespace drift::diagnose_test {
namespace {

using namespace drift::test;

/// A case with misalignment, written to a file.
std::string tilted_case(const ScratchFolder& folder) {
  Theta theta = Theta::Zero();
  for (const char* key : {"D_F_x", "D_F_y", "D_F_z"}) set(theta, key, 900.0);
  set(theta, "eta_x", 3000.0);
  set(theta, "xi_y", -3000.0);
  const std::string path = folder.file("case.csv");
  write_recording(strapdown_recording({.dwells = 14, .rest = 4.0, .seed = 4}, theta), path);
  return path;
}

TEST(DiagnoseCommand, NamesWhatACaseLacksAndLeavesAReport) {
  const ScratchFolder folder;
  const Answer a = driftscope("diagnose " + test::config("diagnose_xsens.toml") + " " +
                              tilted_case(folder) + " --full -o " + folder.file("out"));
  ASSERT_EQ(a.code, 0) << a.err;
  EXPECT_NE(
      a.out.find("Verdict named: The nominal model lacks misalignment of the gyro input axes"),
      std::string::npos)
      << a.out;
  const auto json = nlohmann::json::parse(text_of(folder.file("out") + "/diagnosis.json"));
  EXPECT_EQ(json["verdict"], "named");
  // What was put in and nothing else, of two gyros.
  std::set<std::string> found;
  for (const auto& cause : json["causes"])
    for (const auto& p : cause["parameters"])
      found.insert(cause["term"].get<std::string>() + " " + p["key"].get<std::string>());
  EXPECT_EQ(found, (std::set<std::string>{"gyro_misalignment eta_x", "gyro_misalignment xi_y"}));
  EXPECT_EQ(json["model"], "patched.toml");
  for (const char* name :
       {"report.html", "residual_signal.csv", "identification.json", "study.toml", "where.svg"})
    EXPECT_GT(std::filesystem::file_size(folder.file("out") + "/" + name), 100u) << name;
  const Answer check = driftscope("check " + folder.file("out") + "/patched.toml");
  EXPECT_EQ(check.code, 0) << check.err;
  const Answer again =
      driftscope("diagnose " + folder.file("out") + "/patched.toml " + folder.file("case.csv"));
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_NE(again.out.find("Verdict consistent"), std::string::npos) << again.out;
}

TEST(DiagnoseCommand, AFolderThatCannotBeWrittenIsSaidBeforeAnythingIsComputed) {
  const ScratchFolder folder;
  const std::string file = folder.write("file", "no folder"), recording = tilted_case(folder);
  for (const std::string& out :
       {file + "/out", std::string("/proc/no/folder"), std::string("/proc/self")}) {
    const Answer a = driftscope("diagnose " + test::config("diagnose_xsens.toml") + " " +
                                recording + " -o " + out);
    EXPECT_EQ(a.code, static_cast<int>(ExitCode::io)) << out;
    EXPECT_NE(a.err.find(out + ": cannot be written"), std::string::npos) << a.err;
    EXPECT_EQ(a.out, "") << "the recording is not even read";
  }
  // A folder that can be written is not made for a recording that cannot be read.
  const Answer a = driftscope("diagnose " + test::config("diagnose_xsens.toml") + " " +
                              folder.file("absent.csv") + " -o " + folder.file("a/b/c"));
  EXPECT_NE(a.code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder.file("a")));
}

/// Six positions; g2_drift is left out of the nominal filter and zero in the truth but for D_SS_x.
std::string platform_study(const std::string& size) {
  return R"(schema = 1
title  = "six"
[site]
latitude = "45.75 deg"
[plan]
preset = "six"
dwell  = "20 min"
sample = "60 s"
[truth]
coupling = "eq5"
terms    = ["fixed_drift", "g_drift", "gyro_misalignment", "D_SS_x"]
[truth.parameters]
D_SS_x = ")" +
         size + R"("
[[filter]]
name     = "nominal"
coupling = "eq5"
terms    = ["fixed_drift", "g_drift", "gyro_misalignment"]
[monte_carlo]
seed = 3
)";
}

TEST(DiagnoseCommand, NamesWhatAPlatformLacksAndItsPatchedStudyIsConsistent) {
  const ScratchFolder folder;
  const std::string study = folder.write("s.toml", platform_study("0.3 deg/h/g^2")),
                    recording = folder.file("r.csv");
  ASSERT_EQ(driftscope("simulate " + study + " -o " + recording).code, 0);
  const Answer a = driftscope("diagnose " + study + " " + recording +
                              " --threads 2 --progress json -o " + folder.file("out"));
  ASSERT_EQ(a.code, 0) << a.err;
  // Every stage is told on stderr, with the time that is left.
  for (const char* stage : {"fit", "examine", "search", "held out", "locate", "starts"})
    EXPECT_NE(a.err.find(std::string("\"stage\":\"") + stage + "\""), std::string::npos) << a.err;
  EXPECT_NE(a.err.find("\"eta_s\":"), std::string::npos);
  EXPECT_NE(a.err.find("\"done\":1.000"), std::string::npos);
  const auto json = nlohmann::json::parse(text_of(folder.file("out") + "/diagnosis.json"));
  EXPECT_EQ(json["verdict"], "named") << a.out;
  ASSERT_EQ(json["causes"].size(), 1u);
  EXPECT_EQ(json["causes"][0]["term"], "g2_drift");
  const auto& found = json["causes"][0]["parameters"][0];
  EXPECT_EQ(found["key"], "D_SS_x");
  EXPECT_NEAR(found["value"].get<double>(), 0.3, 4.0 * found["sigma"].get<double>());
  EXPECT_GT(json["fit"]["held_out"]["log_score_gain"].get<double>(), 0.0);
  EXPECT_EQ(json["fit"]["held_out"]["method"], "refitted");
  EXPECT_TRUE(json["fit"]["start_spread_before"].is_number());
  const Answer again = driftscope("diagnose " + folder.file("out") + "/patched.toml " + recording);
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_NE(again.out.find("Verdict consistent"), std::string::npos) << again.out;
}

TEST(DiagnoseCommand, OfSeveralRecordingsSaysWhichOneATimeBelongsTo) {
  const ScratchFolder folder;
  std::string text = platform_study("0.3 deg/h/g^2");  // every run is of one and the same platform
  text.insert(
      text.find("[[filter]]"),
      "D_F = \"0.2 deg/h\"\nD_I = \"1 deg/h/g\"\nD_O = \"0.1 deg/h/g\"\nD_S = \"-1 deg/h/g\"\n"
      "eta = \"100 arcsec\"\nxi = \"-80 arcsec\"\n");
  const std::string study = folder.write("s.toml", text);
  std::string recordings;
  for (const char* run : {"0", "1"}) {
    const std::string path = folder.file("r" + std::string(run) + ".csv");
    ASSERT_EQ(driftscope("simulate " + study + " -o " + path + " --run " + run).code, 0);
    recordings += " " + path;
  }
  const Answer a = driftscope("diagnose " + study + recordings + " --full --progress none -o " +
                              folder.file("out"));
  ASSERT_EQ(a.code, 0) << a.err;
  EXPECT_NE(a.out.find("r1.csv begins at 7200 s (0 s of its own time)"), std::string::npos)
      << a.out;
  const auto json = nlohmann::json::parse(text_of(folder.file("out") + "/diagnosis.json"));
  const auto& spans = json["where"]["recordings"];
  ASSERT_EQ(spans.size(), 2u);
  EXPECT_EQ(spans[0]["end_s"], 7200.0);
  EXPECT_EQ(spans[1]["offset_s"], 7200.0);
  ASSERT_EQ(json["verdict"], "named") << a.out;
  EXPECT_EQ(json["fit"]["held_out"]["by_recording"]["each"][1]["name"], "recording 2, r1.csv");
  EXPECT_TRUE(json["where"]["windows"].empty()) << "what acts always has none";
  const std::string csv = text_of(folder.file("out") + "/residual_signal.csv");
  EXPECT_NE(csv.find(",unit,recording\n"), std::string::npos);
  for (const char* name : {",r0.csv\n", ",r1.csv\n"})
    EXPECT_NE(csv.find(name), std::string::npos) << name;
}

TEST(DiagnoseCommand, TheWrongPlanIsSaidAndOddInputIsRemarked) {
  const ScratchFolder folder;
  const std::string study = folder.write("s.toml", platform_study("0 deg/h/g^2")),
                    recording = folder.file("r.csv");
  ASSERT_EQ(driftscope("simulate " + study + " -o " + recording).code, 0);
  const Answer wrong = driftscope("diagnose " + study + " " + recording +
                                  " --set plan.preset=twelve --set plan.sample='30 s'");
  EXPECT_EQ(wrong.code, recording_error);
  EXPECT_NE(wrong.err.find("samples are 60 s apart"), std::string::npos) << wrong.err;
  const Answer other =
      driftscope("diagnose " + study + " " + recording + " --set plan.preset=apollo10");
  EXPECT_EQ(other.code, recording_error);
  EXPECT_NE(other.err.find("Is this the plan"), std::string::npos) << other.err;
  // A channel that stands still is left out, and said; nothing is blamed for it.
  Recording r = read_recording(recording, RecordingKind::platform, 9.80665);
  for (Channel& c : r.channels)
    if (c.name == "gimbal_inner") c.values.assign(c.values.size(), 0.1);
  write_recording(r, folder.file("stuck.csv"));
  const Answer stuck = driftscope("diagnose --full " + study + " " + folder.file("stuck.csv"));
  EXPECT_EQ(stuck.code, 0) << stuck.err;
  EXPECT_NE(stuck.out.find("gimbal_inner stands still for 120 samples"), std::string::npos)
      << stuck.out;
  EXPECT_NE(stuck.out.find("Verdict consistent"), std::string::npos) << stuck.out;
}

TEST(DiagnoseCommand, AnAbsentChannelIsAnEmptyOne) {
  const ScratchFolder folder;
  const std::string study = folder.write("s.toml", platform_study("0.3 deg/h/g^2")),
                    recording = folder.file("r.csv");
  ASSERT_EQ(driftscope("simulate " + study + " -o " + recording).code, 0);
  Recording r = read_recording(recording, RecordingKind::platform, 9.80665);
  for (Channel& c : r.channels)
    if (c.name == "acc_z") c.values.assign(c.values.size(), std::nan(""));
  write_recording(r, folder.file("empty.csv"));
  std::erase_if(r.channels, [](const Channel& c) { return c.name == "acc_z"; });
  write_recording(r, folder.file("absent.csv"));
  const Answer empty = driftscope("diagnose --full " + study + " " + folder.file("empty.csv"));
  const Answer absent = driftscope("diagnose --full " + study + " " + folder.file("absent.csv"));
  ASSERT_EQ(absent.code, 0) << absent.err;
  EXPECT_NE(absent.out.find("no acc_z: taken as not measured"), std::string::npos) << absent.out;
  EXPECT_NE(absent.out.find("would show is not seen"), std::string::npos) << absent.out;
  const auto answer = [](const std::string& out) {
    return out.substr(out.find("\nVerdict"),
                      out.find("\n!", out.find("\nVerdict")) - out.find("\nVerdict"));
  };
  EXPECT_EQ(answer(absent.out), answer(empty.out));
  EXPECT_NE(absent.out.find("D_SS_x"), std::string::npos) << absent.out;
  EXPECT_EQ(driftscope("identify " + study + " " + folder.file("absent.csv")).code, 0);
}

TEST(DiagnoseCommand, AdvisesOnRequest) {
  const ScratchFolder folder;
  const std::string study = folder.write("s.toml", platform_study("0 deg/h/g^2")),
                    recording = folder.file("r.csv");
  ASSERT_EQ(driftscope("simulate " + study + " -o " + recording).code, 0);
  const std::string diagnose = "diagnose " + study + " " + recording;
  EXPECT_EQ(driftscope(diagnose + " --full").out.find("one prior sigma"), std::string::npos);
  const Answer a =
      driftscope(diagnose + " --advise torquer_heating.x,sag -o " + folder.file("out"));
  ASSERT_EQ(a.code, 0) << a.err;
  const auto json = nlohmann::json::parse(text_of(folder.file("out") + "/diagnosis.json"));
  EXPECT_EQ(json["verdict"], "consistent");
  ASSERT_FALSE(json["advice"].empty());
  EXPECT_FALSE(json["advice"][0]["plan"].empty());
  EXPECT_EQ(driftscope("check " + folder.file("out") + "/advised.toml").code, 0);
  // Without terms: whatever the plan hides. The option does not swallow the files behind it.
  const Answer all = driftscope("diagnose --full --advise " + study + " " + recording);
  ASSERT_EQ(all.code, 0) << all.err;
  EXPECT_NE(all.out.find("effects at one prior sigma"), std::string::npos) << all.out;
  const Answer wrong = driftscope(diagnose + " --advise=sagg,D_F_x");
  EXPECT_EQ(wrong.code, static_cast<int>(ExitCode::usage));
  EXPECT_NE(wrong.err.find("Did you mean 'sag'"), std::string::npos) << wrong.err;
  EXPECT_NE(wrong.err.find("D_F_x"), std::string::npos) << wrong.err;
  EXPECT_EQ(driftscope("diagnose " + test::config("diagnose_xsens.toml") + " " +
                       tilted_case(folder) + " --advise")
                .code,
            static_cast<int>(ExitCode::usage));
}

TEST(DiagnoseCommand, RefusesWhatItCannotDiagnose) {
  const ScratchFolder folder;
  EXPECT_EQ(driftscope("diagnose " + test::config("diagnose_xsens.toml")).code,
            static_cast<int>(ExitCode::usage));
  EXPECT_EQ(driftscope("diagnose " + test::config("diagnose_xsens.toml") + " " +
                       folder.file("absent.csv"))
                .code,
            static_cast<int>(ExitCode::io));
  const std::string no_gyros =
      folder.write("r.csv", "time [s],acc_x [g],acc_y [g],acc_z [g]\n1,0,0,1\n2,0,0,1\n");
  const Answer a = driftscope("diagnose " + test::config("diagnose_xsens.toml") + " " + no_gyros);
  EXPECT_EQ(a.code, recording_error);
  EXPECT_NE(a.err.find("gyro_x"), std::string::npos) << a.err;
}

TEST(DiagnoseCommand, AnEffectFarBeyondItsPriorIsNamedThoughATwinCouldTakeASharePayingLess) {
  const ScratchFolder
      folder;  // six prior sigmas; base motion leaves the same trace in a steady field
  const std::string terms =
      "\"fixed_drift\", \"g_drift\", \"g2_drift\", \"gyro_misalignment\", \"torquer_scale\", "
      "\"accelerometer\"";
  const std::string study = folder.write(
      "lab.toml",
      "schema = 1\n[site]\nlatitude = \"48.1 deg\"\n[plan]\npreset = \"twelve\"\nmode = \"free\"\n"
      "dwell = \"60 min\"\nsample = \"120 s\"\n[environment]\nfield_n = \"0.21 gauss\"\n"
      "field_w = \"0.01 gauss\"\nfield_u = \"-0.43 gauss\"\n[truth]\ncoupling = \"eq5\"\nterms = "
      "[" +
          terms +
          ", \"magnetic_drift\"]\n[truth.parameters]\nM_x = \"0 deg/h/gauss\"\nM_y = \"0.06 "
          "deg/h/gauss\"\nM_z = \"0 deg/h/gauss\"\n[[filter]]\nname = \"nominal\"\ncoupling = "
          "\"eq5\"\nterms = [" +
          terms + "]\n[monte_carlo]\nseed = 31\n");
  const std::string recording = folder.file("r.csv");
  ASSERT_EQ(driftscope("simulate " + study + " -o " + recording).code, 0);
  const std::string out = folder.file("out");
  const Answer a =
      driftscope("diagnose " + study + " " + recording + " -o " + out + " --progress none");
  EXPECT_NE(a.out.find("Verdict named"), std::string::npos) << a.out;
  EXPECT_NE(a.out.find("magnetic_drift.y: M_y = 0.0"), std::string::npos) << a.out;
  // What was found is not held back by the prior, nor called wrong for it.
  EXPECT_EQ(text_of(out + "/patched.toml")
                .find("# As wide as the size that was found is the prior "
                      "of M_y (0.0"),
            0u)
      << text_of(out + "/patched.toml").substr(0, 200);
  const Answer patched = driftscope("identify " + out + "/patched.toml " + recording);
  EXPECT_EQ(patched.out.find("Fits: "), 0u) << patched.out;
  EXPECT_EQ(patched.out.find("wrong priors"), std::string::npos) << patched.out;
}

}  // namespace
}  // namespace drift::diagnose_test
