// The program as a user runs it: commands, files, exit codes.
#include <nlohmann/json.hpp>

#include "core/base/check.hpp"
#include "tests/analysis/report/own_script.hpp"
#include "tests/support/program.hpp"
#include "tests/support/short_study.hpp"

namespace drift::commands_test {
namespace {

using namespace drift::test;

TEST(Program, EveryConfigurationThatIsShippedIsValid) {
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(DRIFT_SOURCE_DIR) + "/configs")) {
    if (entry.is_directory()) continue;  // job scripts
    const Answer a = driftscope("check '" + entry.path().string() + "'");
    EXPECT_EQ(a.code, 0) << entry.path() << "\n" << a.err;
    EXPECT_NE(a.out.find("filter"), std::string::npos);
  }
}

TEST(Program, CheckPrintsEveryValueAndWhereItCameFrom) {
  const ScratchFolder folder;
  const Answer a =
      driftscope("check " + folder.write("s.toml", short_study) + " --set plan.dwell='20 min'");
  ASSERT_EQ(a.code, 0) << a.err;
  EXPECT_NE(a.out.find("20 min"), std::string::npos);
  EXPECT_NE(a.out.find("--set"), std::string::npos);
  EXPECT_NE(a.out.find("s.toml:4"), std::string::npos);
  EXPECT_NE(a.out.find("default prior"), std::string::npos);
}

TEST(Program, MistakesInAStudyAreLocatedAndExitWith3) {
  const ScratchFolder folder;
  const Answer a =
      driftscope("identify " + folder.write("s.toml", std::string(short_study) + "\n[readuot]\n"));
  EXPECT_EQ(a.code, config_error);
  EXPECT_NE(a.err.find("s.toml:"), std::string::npos) << a.err;
  EXPECT_NE(a.err.find("readout"), std::string::npos) << a.err;
  EXPECT_TRUE(a.out.empty());
  EXPECT_EQ(driftscope("check " + folder.file("absent.toml")).code, config_error);
}

TEST(Program, AWrongCommandLineExitsWith2) {
  for (const char* line : {"", "bogus", "check", "simulate x.toml", "identify --threads 0 x.toml",
                           "terms no_such_term", "check x.toml --set nonsense"})
    EXPECT_EQ(driftscope(line).code, usage_error) << line;
  EXPECT_EQ(driftscope("--help").code, 0);
  EXPECT_EQ(driftscope("identify --help").code, 0);
}

TEST(Program, ARecordingGivesTheSameAnswerAsTheSimulationItCameFrom) {
  const ScratchFolder folder;
  const std::string study = folder.write("s.toml", short_study);
  ASSERT_EQ(driftscope("identify " + study + " --run 2 -o " + folder.file("direct")).code, 0);
  const auto read = [&](const std::string& name) {
    return nlohmann::json::parse(text_of(folder.file(name) + "/identification.json"));
  };
  const auto direct = read("direct");
  for (const char* format : {"csv", "h5", "mat"}) {
    const std::string recording = folder.file(std::string("rec.") + format);
    const Answer s = driftscope("simulate " + study + " --run 2 -o " + recording);
    ASSERT_EQ(s.code, 0) << s.err;
    EXPECT_NE(s.out.find("60"), std::string::npos);  // the quality card counts 60 rows
    const std::string out = std::string("from_") + format;
    const Answer a = driftscope("identify " + study + " " + recording + " -o " + folder.file(out));
    ASSERT_EQ(a.code, 0) << a.err;
    const auto again = read(out);
    for (const auto& [key, value] :
         direct["filters"][0]["starts"][0]["ekf"]["parameters"].items()) {
      const double expected = value["estimate"], sigma = value["sigma"];
      const double got = again["filters"][0]["starts"][0]["ekf"]["parameters"][key]["estimate"];
      EXPECT_NEAR(got, expected, 1e-6 * sigma) << key << " " << format;
    }
  }
}

TEST(Program, IdentifyLeavesTablesPicturesAndAPage) {
  const ScratchFolder folder;
  const Answer a =
      driftscope("identify " + folder.write("s.toml", short_study) + " -o " + folder.file("out"));
  ASSERT_EQ(a.code, 0) << a.err;
  for (const char* name :
       {"identification.json", "estimates.svg", "figure_corrected.svg", "figure_legacy.svg",
        "nis.svg", "report.html", "study.toml", "recording.csv", "estimates.csv", "covariance.csv",
        "residuals.csv", "identification.nc"})
    EXPECT_GT(std::filesystem::file_size(folder.file("out") + "/" + name), 100u) << name;
  const std::string page = text_of(folder.file("out") + "/report.html");
  EXPECT_EQ(page.find("http://"), page.find("http://www.w3.org"));  // nothing but the SVG namespace
  EXPECT_EQ(test::without_own_script(page).find("<script"), std::string::npos);
  const Answer again = driftscope("check " + folder.file("out") + "/study.toml");
  EXPECT_EQ(again.code, 0) << again.err;
}

TEST(Program, ResultsDoNotDependOnTheNumberOfThreads) {
  const ScratchFolder folder;
  const std::string study = folder.write("s.toml", short_study);
  for (const char* n : {"1", "2", "3"})
    ASSERT_EQ(driftscope("identify " + study + " --threads " + n + " -o " + folder.file(n)).code,
              0);
  const auto found = [&](const std::string& n) {
    auto json = nlohmann::json::parse(text_of(folder.file(n) + "/identification.json"));
    EXPECT_EQ(json.erase("provenance"), 1u) << "has the command line";
    return json.dump();
  };
  EXPECT_EQ(found("1"), found("2"));
  EXPECT_EQ(found("1"), found("3"));
}

TEST(Program, ARecordingOfAnotherPlanIsRefused) {
  const ScratchFolder folder;
  const std::string study = folder.write("s.toml", short_study), recording = folder.file("r.csv");
  ASSERT_EQ(driftscope("simulate " + study + " -o " + recording).code, 0);
  const Answer other =
      driftscope("identify " + study + " " + recording + " --set plan.preset='apollo10'");
  EXPECT_EQ(other.code, recording_error);
  EXPECT_NE(other.err.find("attitude in the plan"), std::string::npos) << other.err;
  EXPECT_NE(other.err.find("r.csv:"), std::string::npos) << other.err;
  // Evenly spaced rows that are no whole part of the plan's samples: is this the plan? Two of them
  // make one sample of 120 s.
  const Answer sample =
      driftscope("identify " + study + " " + recording + " --set plan.sample='100 s'");
  EXPECT_EQ(sample.code, recording_error) << sample.err;
  EXPECT_NE(sample.err.find("samples are 60 s apart, in the plan 100 s"), std::string::npos);
  const Answer twice =
      driftscope("identify " + study + " " + recording + " --set plan.sample='120 s'");
  EXPECT_EQ(twice.code, 0) << twice.err;
  EXPECT_NE(twice.err.find("60 rows 60 s apart are taken as 30 of 120 s"), std::string::npos)
      << twice.err;
}

TEST(Program, AGapInATorquedSequenceIsClosedByTheGimbalsAndRefusedWithoutThem) {
  const ScratchFolder folder;
  const std::string study = folder.write("s.toml", short_study), recording = folder.file("r.csv");
  ASSERT_EQ(driftscope("simulate " + study + " --set plan.entry=torqued -o " + recording).code, 0);
  std::string text = text_of(recording), kept;
  std::size_t data_line = 0, at = 0;
  while (at < text.size()) {  // without data rows 15 to 17: the end of a slew, and rest
    const auto end = text.find('\n', at) + 1;
    const bool data = std::isdigit(static_cast<unsigned char>(text[at])) != 0;
    data_line += data;
    if (!(data && data_line >= 15 && data_line < 18)) kept += text.substr(at, end - at);
    at = end;
  }
  const std::string gap = folder.write("gap.csv", kept);
  for (const char* command : {"identify ", "diagnose "}) {
    const Answer seen = driftscope(command + study + " --set plan.entry=torqued " + gap +
                                   (command[0] == 'd' ? " --set filter.corrected.starts=1" : ""));
    EXPECT_NE(seen.code, recording_error) << command << seen.err;
    for (std::size_t k = 0; (k = kept.find("gimbal_", k)) != std::string::npos; ++k)
      kept.replace(k, 7, "unknown");
    const Answer blind = driftscope(command + study + " --set plan.entry=torqued " +
                                    folder.write("blind.csv", kept));
    EXPECT_EQ(blind.code, recording_error) << command;
    EXPECT_NE(blind.err.find("rows are missing before this one"), std::string::npos) << blind.err;
  }
}

TEST(Program, WhatCannotBeWrittenExitsWith6) {
  const ScratchFolder folder;
  const std::string study = folder.write("s.toml", short_study);
  EXPECT_EQ(driftscope("simulate " + study + " -o " + folder.file("no/such/folder/r.csv")).code,
            io_error);
  folder.write("file", "in the way");
  const Answer a = driftscope("identify " + study + " -o " + folder.file("file"));
  EXPECT_EQ(a.code, io_error) << a.err;
  EXPECT_EQ(driftscope("identify " + study + " " + folder.file("absent.csv")).code, io_error);
}

TEST(Program, ALoopThatIsFedBackHasNoRecordingOfItsOwn) {
  const Answer a =
      driftscope("simulate " + test::config("compensated.toml") + " -o /tmp/never.csv");
  EXPECT_EQ(a.code, config_error);
  EXPECT_NE(a.err.find("given"), std::string::npos) << a.err;
}

TEST(Program, ASureLoopWithTheTruthIsEquation6) {
  // The loop is given the true misalignments: filter eq6 is then matched, filter eq5 is not.
  const ScratchFolder folder;
  std::string text = short_study;
  const std::string truth =
      "[truth]\ncoupling = \"compensated\"\nterms = [\"fixed_drift\", \"g_drift\", "
      "\"gyro_misalignment\"]\n"
      "[truth.parameters]\neta_x = \"300 arcsec\"\neta_y = \"0 arcsec\"\neta_z = \"0 arcsec\"\nxi "
      "= \"0 arcsec\"\n"
      "[truth.loop]\nestimate = \"given\"\neta_x = \"300 arcsec\"\n";
  text.replace(text.find("[truth]\ncoupling = \"eq5\"\n"),
               std::string("[truth]\ncoupling = \"eq5\"\n").size(), truth);
  text.replace(text.find("preset = \"six\""), 14, "preset = \"casespin\"");
  const Answer a =
      driftscope("identify " + folder.write("s.toml", text) + " -o " + folder.file("out"));
  ASSERT_EQ(a.code, 0) << a.err;
  const auto j = nlohmann::json::parse(text_of(folder.file("out") + "/identification.json"));
  const auto cost = [&](int filter) -> double {
    return j["filters"][filter]["starts"][0]["batch"]["chi2_per_dof"];
  };
  // Five sigma of chi-square over its m degrees of freedom, m = 6 x 114 scalars: 5 sqrt(2/684) =
  // 0.27.
  EXPECT_GT(cost(0), 1.27);
  EXPECT_NEAR(cost(1), 1.0, 0.27);
}

TEST(Program, StandardOutputThatIsFullOrGoneIsNoBug) {
  const ScratchFolder folder;
  const std::string study = folder.write("s.toml", short_study);
  const std::string program = std::string("'") + DRIFT_PROGRAM + "' ";
  const auto code = [&](const std::string& line) { return WEXITSTATUS(std::system(line.c_str())); };
  EXPECT_EQ(code(program + "check " + study + " >/dev/full 2>'" + folder.file("err") + "'"),
            io_error);
  EXPECT_EQ(text_of(folder.file("err")).find("bug"), std::string::npos);
  for (const char* words : {"--version", "--help", "run --help", "help", "version"})
    EXPECT_EQ(code(program + words + " >/dev/full 2>/dev/null"), io_error) << words;
  EXPECT_EQ(code("(" + program + "identify " + study + " --progress none 2>'" + folder.file("err") +
                 "') | head -n 1 >/dev/null"),
            0);
  EXPECT_EQ(text_of(folder.file("err")), "");
}

TEST(Program, MeasurementsBeyondReasonAreRefused) {
  const ScratchFolder folder;
  const std::string study = folder.write("s.toml", short_study), recording = folder.file("r.csv");
  ASSERT_EQ(driftscope("simulate " + study + " -o " + recording).code, 0);
  const std::string text = text_of(recording);
  const auto row = text.find("\n1200,");  // the row at 1200 s; its third comma ends `phase`
  auto comma = row;
  for (int k = 0; k < 3; ++k) comma = text.find(',', comma + 1);
  const std::string spoiled =
      text.substr(0, comma + 1) + "1e300" + text.substr(text.find(',', comma + 1));
  const Answer a = driftscope("identify " + study + " " + folder.write("bad.csv", spoiled));
  EXPECT_EQ(a.code, recording_error);
  EXPECT_NE(a.err.find("acc_x"), std::string::npos) << a.err;
  EXPECT_NE(a.err.find("beyond reason"), std::string::npos) << a.err;
}

TEST(Program, TheTruthOfLambdaIsTheEquationThatMadeTheData) {
  const ScratchFolder folder;
  std::string text = short_study;
  text.replace(text.find("coupling = \"eq6\""), 16, "coupling = \"lambda\"");
  const std::string study = folder.write("s.toml", text);
  for (const auto& [coupling, lambda] : {std::pair{"eq5", 0.0}, {"eq6", 1.0}, {"servo", 1.0}}) {
    ASSERT_EQ(driftscope("identify " + study + " --set truth.coupling=" + coupling + " -o " +
                         folder.file(coupling))
                  .code,
              0);
    const auto j = nlohmann::json::parse(text_of(folder.file(coupling) + "/identification.json"));
    EXPECT_EQ(j["filters"][1]["parameters"]["lambda"]["truth"].get<double>(), lambda) << coupling;
  }
}

TEST(Program, IdentifiesWithTermsThatNeedCovariates) {
  const ScratchFolder folder;
  std::string text = short_study;
  const std::string terms =
      "\nterms = [\"fixed_drift\", \"magnetic_drift\", \"temperature_drift\", "
      "\"encoder_harmonics\"]";
  for (std::size_t at = text.find("coupling"); at != std::string::npos;
       at = text.find("coupling", at + 1))
    text.insert(text.find('\n', at), terms);
  const std::string bare = folder.write("bare.toml", text);
  const std::string study = folder.write("s.toml", text + R"(
[environment]
temperature = "20 degC"
temperature_amplitude = "0.5 degC"
temperature_period = "2 h"
field_n = "0.26 gauss"
field_w = "0 gauss"
field_u = "-0.48 gauss"
)");
  const std::string recording = folder.file("r.csv");
  ASSERT_EQ(driftscope("simulate " + study + " -o " + recording).code, 0);
  for (const char* column : {"temperature [degC]", "field_n [gauss]", "field_u [gauss]"})
    EXPECT_NE(text_of(recording).find(column), std::string::npos) << column;
  // Simulated within, or read from the file: the same test.
  ASSERT_EQ(driftscope("identify " + study + " -o " + folder.file("a")).code, 0);
  ASSERT_EQ(driftscope("identify " + bare + " " + recording + " -o " + folder.file("b")).code, 0);
  const auto a = nlohmann::json::parse(text_of(folder.file("a") + "/identification.json"));
  const auto b = nlohmann::json::parse(text_of(folder.file("b") + "/identification.json"));
  EXPECT_NE(a.dump().find("\"M_y\""), std::string::npos);
  EXPECT_NE(b.dump().find("\"enc_s2_inner\""), std::string::npos);
  // Without them the user is told what is missing.
  const Answer missing = driftscope("identify " + bare);
  EXPECT_NE(missing.code, 0);
  EXPECT_NE(missing.err.find("temperature [degC]"), std::string::npos) << missing.err;
}

}  // namespace
}  // namespace drift::commands_test
