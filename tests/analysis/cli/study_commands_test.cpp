// run, status, verify, replay and export through the program, with cheap runs
// (synthetic_program.cpp).
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/program.hpp"

namespace drift::study_commands_test {
namespace {

using test::Answer;
using test::ScratchFolder;

/// A study file whose runs do as `words` say.
std::string study_file(const ScratchFolder& scratch, const std::string& words,
                       const std::string& runs = "200") {
  return scratch.write(
      "study.toml",
      "schema = 1\ntitle = \"synthetic " + words +
          "\"\n[site]\nlatitude = \"45.75 deg\"\n"
          "[plan]\npreset = \"six\"\n[truth]\ncoupling = \"eq5\"\n[[filter]]\nname = \"eq5\"\n"
          "coupling = \"eq5\"\n[monte_carlo]\nruns = " +
          runs + "\nseed = 7\n");
}

Answer program(const std::string& arguments) {
  return test::run_program(DRIFT_SYNTHETIC, arguments);
}

std::string line_with(const std::string& text, const std::string& start) {
  const auto at = text.find(start);
  return at == std::string::npos ? "no line " + start : text.substr(at, text.find('\n', at) - at);
}

TEST(StudyCommands, ARunIsStoredShownVerifiedReplayedAndExported) {
  const ScratchFolder scratch;
  const std::string config = study_file(scratch, "points=2"), out = scratch.file("out");
  const Answer run = program("run " + config + " -o " + out);
  ASSERT_EQ(run.code, 0) << run.err;
  const std::string results = line_with(run.out, "results ");
  EXPECT_EQ(program("run " + config + " --threads 1 -o " + out).out, run.out);
  const Answer status = program("status " + out);
  EXPECT_EQ(status.code, 0) << status.err;
  EXPECT_NE(status.out.find("400 of 400 runs, 0 failed, 2 of 2 points complete"), std::string::npos)
      << status.out;
  const Answer verify = program("verify " + out + " --sample 10%");
  EXPECT_EQ(verify.code, 0) << verify.err;
  EXPECT_EQ(line_with(verify.out, "results "), results);
  const std::string trace = scratch.file("trace.csv");
  const Answer replay = program("replay " + out + " --run 17 --point 1 --trace " + trace);
  EXPECT_EQ(replay.code, 0) << replay.err;
  EXPECT_NE(replay.out.find("bit for bit"), std::string::npos) << replay.out;
  EXPECT_EQ(test::text_of(trace).substr(0, 24), "time [s],value [arcsec]\n");
  const std::string json = scratch.file("x.json"), csv = scratch.file("x.csv");
  EXPECT_EQ(program("export " + out + " --format json -o " + json).code, 0);
  EXPECT_EQ(program("export " + out + " --format csv -o " + csv).code, 0);
  const auto j = nlohmann::json::parse(test::text_of(json));
  EXPECT_EQ(j["points"][1]["runs"].size(), 200u);
  EXPECT_EQ(j["provenance"]["seed"], "7");
  // The shortest digits of CSV and JSON read back as the same number.
  const std::string row = line_with(test::text_of(csv), "1,17,ok,");
  EXPECT_EQ(std::stod(row.substr(8)), j["points"][1]["runs"][17][2].get<double>()) << row;
}

TEST(StudyCommands, AnotherStudyInTheFolderIsRefused) {
  const ScratchFolder scratch;
  const std::string config = study_file(scratch, ""), out = scratch.file("out");
  ASSERT_EQ(program("run " + config + " -o " + out).code, 0);
  const Answer other = program("run " + config + " --seed 8 -o " + out);
  EXPECT_EQ(other.code, 7);
  EXPECT_NE(other.err.find("- seed = 7\n  + seed = 8"), std::string::npos) << other.err;
  EXPECT_EQ(program("run " + config + " --seed 7 --runs 300 -o " + out).code, 0)
      << "the same study, extended";
  // The order of keys, comments and the number of runs do not make another study.
  const std::string text = test::text_of(config);
  scratch.write("study.toml", "# a comment\ntitle = \"synthetic \"\n" +
                                  text.substr(0, text.find("title")) +
                                  text.substr(text.find("[site]")) + "allowed_failures = 3\n");
  EXPECT_EQ(program("run " + config + " -o " + out).code, 0);
  scratch.write("out/study.toml", text + "[[filter]]\nname = \"b\"\ncoupling = \"eq6\"\n");
  EXPECT_EQ(program("verify " + out).code, 7) << "study.toml in the folder was changed";
}

TEST(StudyCommands, TheReportIsMadeAnewAndAFolderOfAnotherCommandIsRefused) {
  const ScratchFolder scratch;
  const std::string config = study_file(scratch, ""), out = scratch.file("out");
  ASSERT_EQ(program("run " + config + " -o " + out).code, 0);
  EXPECT_EQ(program("report " + out).code, 0);
  const std::string before = test::text_of(out + "/study.toml");
  for (const char* command : {"rank ", "identify "}) {
    const Answer other = program(command + config + " -o " + out);
    EXPECT_EQ(other.code, 7) << command;
    EXPECT_NE(other.err.find("holds the results of `run`"), std::string::npos) << other.err;
  }
  EXPECT_EQ(test::text_of(out + "/study.toml"), before);
  EXPECT_EQ(program("verify " + out).code, 0);
  const std::string ranked = scratch.file("ranked");
  std::filesystem::create_directories(ranked);
  scratch.write("ranked/rank.json", R"({"schema": 1, "linearised_at": "prior means"})");
  EXPECT_EQ(program("run " + config + " -o " + ranked).code, 7);
  const Answer lost = program("report " + ranked);
  EXPECT_EQ(lost.code, 7);
  EXPECT_NE(lost.err.find("driftscope rank"), std::string::npos) << lost.err;
  EXPECT_EQ(program("report " + scratch.file("")).code, 7);
}

TEST(StudyCommands, FailedRunsAreCountedListedAndDecideTheExitCode) {
  const ScratchFolder scratch;
  const std::string config = study_file(scratch, "fail_every=50 throw_at=3"),
                    out = scratch.file("out");
  const Answer run = program("run " + config + " -o " + out);
  EXPECT_EQ(run.code, 5);
  EXPECT_NE(run.err.find("failed: point 0, run 3: error at t = 0 s: thrown by run 3. Look closer: "
                         "driftscope replay " +
                         out + " --run 3"),
            std::string::npos)
      << run.err;
  EXPECT_EQ(program("run " + config + " --set monte_carlo.allowed_failures=5 -o " + out).code, 0);
  EXPECT_EQ(program("replay " + out + " --run 49").code, 0)
      << "a failed run comes out again as it was";
  const Answer fast =
      program("run " + config + " --threads 1 --fail-fast -o " + scratch.file("fast"));
  EXPECT_EQ(fast.code, 5);
  EXPECT_NE(fast.err.find("failed: point 0, run 3: error at t = 0 s: thrown by run 3. Look closer"),
            std::string::npos)
      << fast.err;
  EXPECT_NE(fast.err.find("as --fail-fast asks"), std::string::npos) << fast.err;
  EXPECT_EQ(fast.err.find("of the runs failed"), std::string::npos) << "none of those stored did";
}

TEST(StudyCommands, WallTimeIsExitCode75AndTheSameCommandGoesOn) {
  const ScratchFolder scratch;
  const std::string config = study_file(scratch, "ms=2"), out = scratch.file("out");
  const Answer stopped = program("run " + config + " --threads 2 --max-wall 0.05s -o " + out);
  EXPECT_EQ(stopped.code, 75) << stopped.err;
  EXPECT_EQ(program("run " + config + " -o " + out).code, 0);
}

TEST(StudyCommands, ADiskThatIsFullIsExitCode6AndNothingIsLost) {
  const ScratchFolder scratch;
  const std::string config = study_file(scratch, "columns=40", "600"), out = scratch.file("out");
  const Answer whole = program("run " + config + " -o " + scratch.file("whole"));
  ASSERT_EQ(whole.code, 0) << whole.err;
  // 100 kB per file: some blocks of 21 kB fit, not all ten.
  const Answer full = test::run_program(
      "/bin/bash", "-c \"ulimit -f 100; '" DRIFT_SYNTHETIC "' run " + config + " -o " + out + "\"");
  EXPECT_EQ(full.code, 6) << full.err;
  EXPECT_NE(full.err.find("worker-0000.sqlite: cannot be written"), std::string::npos) << full.err;
  EXPECT_NE(full.err.find("run the same command again"), std::string::npos) << full.err;
  EXPECT_EQ(program("verify " + out).code, 0);
  const Answer resumed = program("run " + config + " -o " + out);
  EXPECT_EQ(resumed.out, whole.out);
  EXPECT_EQ(line_with(resumed.err, out + ": 0 runs stored before"),
            "no line " + out + ": 0 runs stored before");
}

TEST(StudyCommands, DamageIsExitCode7AndOtherResultsAreExitCode8) {
  const ScratchFolder scratch;
  const std::string config = study_file(scratch, ""), out = scratch.file("out"),
                    file = out + "/worker-0000.sqlite";
  const Answer run = program("run " + config + " -o " + out);
  std::string bytes = test::text_of(file);
  bytes[bytes.size() - 2000] = static_cast<char>(bytes[bytes.size() - 2000] ^ 1);  // in a payload
  std::ofstream(file, std::ios::binary) << bytes;
  const Answer damaged = program("verify " + out + " --sample 0%");
  EXPECT_EQ(damaged.code, 7) << damaged.out;
  EXPECT_EQ(program("run " + config + " -o " + out).out, run.out);
  EXPECT_EQ(program("verify " + out).code, 0);
  // A program that computes something else: the same study, other runs.
  const Answer other = test::run_program(
      "/usr/bin/env",
      "DRIFT_SYNTHETIC_SCALE=1.0000001 '" DRIFT_SYNTHETIC "' verify " + out + " --sample 5%");
  EXPECT_EQ(other.code, 8) << other.out << other.err;
  EXPECT_EQ(test::run_program("/usr/bin/env", "DRIFT_SYNTHETIC_SCALE=1.0000001 '" DRIFT_SYNTHETIC
                                              "' replay " +
                                                  out + " --run 1")
                .code,
            8);
}

TEST(StudyCommands, ADryRunWritesNothing) {
  const ScratchFolder scratch;
  const std::string config = study_file(scratch, "points=3"), out = scratch.file("out");
  const Answer dry = program("run " + config + " --dry-run -o " + out);
  EXPECT_EQ(dry.code, 0) << dry.err;
  EXPECT_NE(dry.out.find("runs             600 (200 per point, in 12 blocks of 64)"),
            std::string::npos)
      << dry.out;
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(StudyCommands, MistakesOfTheCommandLineAreExitCode2) {
  const ScratchFolder scratch;
  const std::string config = study_file(scratch, ""), out = scratch.file("out");
  for (const char* bad :
       {"--worker 4/4", "--worker 1", "--worker a/b", "--max-wall soon", "--max-wall 0",
        "--max-wall -5m", "--runs 0", "--runs x", "--progress loud", "--threads 0"}) {
    const Answer answer = program("run " + config + " -o " + out + " " + bad);
    EXPECT_EQ(answer.code, 2) << bad << ": " << answer.err;
  }
  EXPECT_FALSE(std::filesystem::exists(out));
  EXPECT_EQ(program("status " + scratch.path()).code, 7) << "no results in the folder";
  ASSERT_EQ(program("run " + config + " -o " + out).code, 0);
  EXPECT_EQ(program("replay " + out + " --run 1 --point 1").code, 2);
  EXPECT_EQ(program("verify " + out + " --sample 101%").code, 2);
  EXPECT_EQ(program("export " + out + " --format xml -o x").code, 2);
  EXPECT_EQ(
      program("export " + out + " --format csv -o " + scratch.file("no/such/folder.csv")).code, 6);
}

TEST(StudyCommands, ProgressComesAsJsonLines) {
  const ScratchFolder scratch;
  const std::string config = study_file(scratch, "");
  const Answer run = program("run " + config + " --progress json -o " + scratch.file("out"));
  const auto line = nlohmann::json::parse(line_with(run.err, "{\"done\""));
  EXPECT_EQ(line["done"], 200);
  EXPECT_EQ(line["total"], 200);
  EXPECT_EQ(line["eta_s"], 0.0);
}

/// How many lines say this; each must be a JSON object.
std::size_t json_lines(const std::string& text, const std::string& level) {
  std::size_t count = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto json = nlohmann::json::parse(line, nullptr, false);
    EXPECT_TRUE(json.is_object()) << line;
    if (json.is_object() && json.value("level", "progress") == level) ++count;
    if (json.is_object() && json.contains("level")) {
      const std::string message = json["message"], its_level = json["level"];
      EXPECT_FALSE(message.empty());
      EXPECT_FALSE(message.starts_with(its_level + ": ") || message.starts_with('\n')) << message;
    }
  }
  return count;
}

TEST(StudyCommands, WithProgressAsJsonEveryLineIsJson) {
  const ScratchFolder scratch;
  const std::string out = scratch.file("out"), run = "run " + study_file(scratch, "fail_every=50") +
                                                     " --progress json -o " + out;
  const Answer first = program(run), again = program(run), other = program(run + " --seed 8"),
               wrong = program(run + " --nonsense"), less = program("run --progress=json");
  EXPECT_EQ(first.code, 5);
  EXPECT_GE(json_lines(first.err, "note"), 3u) << first.err;  // where to, what was done, failures
  EXPECT_GE(json_lines(first.err, "progress"), 1u) << first.err;
  EXPECT_GE(json_lines(again.err, "note"), 2u) << again.err;
  EXPECT_EQ(other.code, 7);
  EXPECT_EQ(json_lines(other.err, "error"), 1u) << other.err;
  EXPECT_EQ(wrong.code, 2);
  EXPECT_GE(json_lines(wrong.err, "error"), 1u) << wrong.err;
  EXPECT_EQ(less.code, 2);
  EXPECT_GE(json_lines(less.err, "error"), 1u) << less.err;
  EXPECT_EQ(json_lines(program(run + " --quiet").err, "note"), 0u);
}

}  // namespace
}  // namespace drift::study_commands_test
