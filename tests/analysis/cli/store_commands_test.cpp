// What the commands that look into a results folder say of lost, damaged and unfinished results.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/synthetic.hpp"

namespace drift::store_commands_test {
namespace {

using test::Answer;
using test::expect_says;
using test::ScratchFolder;
namespace fs = std::filesystem;

std::string study_file(const ScratchFolder& scratch, const std::string& words,
                       const std::string& runs = "200") {
  return scratch.write(
      "study.toml",
      "schema = 1\ntitle = \"synthetic " + words +
          "\"\n[site]\nlatitude = \"45.75 deg\"\n"
          "[plan]\npreset = \"six\"\n[truth]\ncoupling = \"eq5\"\n[[filter]]\nname = \"eq5\"\n"
          "coupling = \"eq5\"\n[monte_carlo]\nruns = " +
          runs + "\nseed = 7\nallowed_failures = 99\n");
}

TEST(StoreCommands, ResultsThatWereThereAreMissed) {
  for (const bool removed : {true, false}) {
    const ScratchFolder scratch;
    const std::string config = study_file(scratch, "points=2"), out = scratch.file("out"),
                      file = out + "/worker-0000.sqlite";
    const Answer run = test::synthetic("run " + config + " -o " + out);
    ASSERT_EQ(run.code, 0) << run.err;
    if (removed) {
      fs::remove(file);
    } else {
      fs::resize_file(file, 0);
    }
    const Answer verify = test::synthetic("verify " + out);
    EXPECT_EQ(verify.code, 7) << verify.out;
    expect_says(verify.out, "0 blocks with 0 runs, 8 missing");
    expect_says(verify.out,
                "lost: point 1, runs 0 to 199: not there, though the study was complete");
    const Answer status = test::synthetic("status " + out);
    expect_says(status.out, "0 of 400 runs, 0 failed, 0 of 2 points complete");
    expect_says(status.out,
                "lost: the study was complete with 200 runs per point; of 2 of 2 points results "
                "are not there");
    const Answer exported = test::synthetic("export " + out + " --format csv");
    EXPECT_EQ(exported.code, 7);
    EXPECT_FALSE(fs::exists(out + "/export.csv"));
    EXPECT_EQ(test::synthetic("run " + config + " -o " + out).out, run.out);
    EXPECT_EQ(test::synthetic("verify " + out).code, 0);
  }
}

TEST(StoreCommands, MoreWorkerFilesThanTheUsualLimitOfOpenFilesAreRead) {
  const ScratchFolder scratch;
  const std::string config = study_file(scratch, ""), out = scratch.file("out");
  ASSERT_EQ(test::synthetic("run " + config + " -o " + out).code, 0);
  for (int worker = 1; worker < 60; ++worker)  // as if sixty had come to the same results
    fs::copy_file(out + "/worker-0000.sqlite", out + "/worker-00" + (worker < 10 ? "0" : "") +
                                                   std::to_string(worker) + ".sqlite");
  const auto limited = [&](const std::string& command) {
    return test::run_program("/bin/sh",
                             "-c \"ulimit -S -n 40; exec '" DRIFT_SYNTHETIC "' " + command + "\"");
  };
  const Answer status = limited("status " + out);
  EXPECT_EQ(status.code, 0) << status.err << status.out;
  expect_says(status.out, "in 60 worker files");
  EXPECT_EQ(status.out.find("damage"), std::string::npos) << status.out;
  expect_says(limited("verify " + out + " --sample 0%").out, "sound and complete");
}

TEST(StoreCommands, AnUnfinishedStudyIsExportedWithAWord) {
  const ScratchFolder scratch;
  const std::string config = study_file(scratch, ""), out = scratch.file("out");
  const Answer part = test::synthetic("run " + config + " --worker 0/2 -o " + out);
  ASSERT_EQ(part.code, 0) << part.err;
  expect_says(part.err, "missing: 2 blocks of runs of the other workers' parts");
  EXPECT_EQ(part.err.find("The same command goes on"), std::string::npos) << part.err;
  const Answer exported = test::synthetic("export " + out + " --format json");
  EXPECT_EQ(exported.code, 0) << exported.err;
  expect_says(exported.err, "the study is not finished: 128 of 200 runs, 0 of 1 points complete");
  expect_says(exported.out, out + "/export.json: 128 runs");
  EXPECT_EQ(test::synthetic("verify " + out).code, 0) << "unfinished is not lost";
}

TEST(StoreCommands, ADamagedFolderIsNotExported) {
  const ScratchFolder scratch;
  const std::string config = study_file(scratch, ""), out = scratch.file("out"),
                    file = out + "/worker-0000.sqlite";
  ASSERT_EQ(test::synthetic("run " + config + " -o " + out).code, 0);
  std::string bytes = test::text_of(file);
  bytes[bytes.size() - 2000] = static_cast<char>(bytes[bytes.size() - 2000] ^ 1);  // in a payload
  std::ofstream(file, std::ios::binary) << bytes;
  const Answer exported = test::synthetic("export " + out + " --format csv");
  EXPECT_EQ(exported.code, 7) << exported.err;
  EXPECT_FALSE(fs::exists(out + "/export.csv"));
}

TEST(StoreCommands, AnExportReplacesAnEarlierOneAndNothingElse) {
  const ScratchFolder scratch;
  const std::string config = study_file(scratch, ""), out = scratch.file("out"),
                    other = scratch.file("other");
  ASSERT_EQ(test::synthetic("run " + config + " -o " + out).code, 0);
  ASSERT_EQ(test::synthetic("run " + config + " --seed 8 -o " + other).code, 0);
  for (const std::string format : {"csv", "json", "hdf5"}) {
    const std::string file = scratch.file("x." + format);
    EXPECT_EQ(test::synthetic("export " + out + " --format " + format + " -o " + file).code, 0);
    const Answer again = test::synthetic("export " + out + " --format " + format + " -o " + file);
    EXPECT_EQ(again.code, 0) << again.err;
    const std::string before = test::text_of(file);
    const Answer refused =
        test::synthetic("export " + other + " --format " + format + " -o " + file);
    EXPECT_EQ(refused.code, 7);
    expect_says(refused.err, "is the export of another study");
    EXPECT_EQ(test::text_of(file), before);
    scratch.write("notes", "mine");
    EXPECT_EQ(
        test::synthetic("export " + out + " --format " + format + " -o " + scratch.file("notes"))
            .code,
        7);
    EXPECT_EQ(test::text_of(scratch.file("notes")), "mine");
  }
  ASSERT_EQ(mkfifo(scratch.file("pipe").c_str(), 0600), 0);
  EXPECT_EQ(test::synthetic("export " + out + " --format csv -o " + scratch.file("pipe")).code, 6);
  EXPECT_EQ(test::synthetic("replay " + out + " --run 1 --trace " + scratch.file("pipe")).code, 6);
  EXPECT_TRUE(fs::is_fifo(scratch.file("pipe")));
}

TEST(StoreCommands, ADiskThatIsFullEndsEveryExportWithExitCode6) {
  const ScratchFolder scratch;
  const std::string config = study_file(scratch, "columns=40", "2000"), out = scratch.file("out");
  ASSERT_EQ(test::synthetic("run " + config + " -o " + out).code, 0);
  for (const std::string format : {"csv", "json", "hdf5"}) {
    const Answer full =
        test::run_program("/bin/bash", "-c \"ulimit -f 200; '" DRIFT_SYNTHETIC "' export " + out +
                                           " --format " + format + "\"");
    EXPECT_EQ(full.code, 6) << format << full.err;
    for (const auto& entry : fs::directory_iterator(out))
      EXPECT_EQ(entry.path().filename().string().find("export"), std::string::npos) << entry.path();
  }
}

TEST(StoreCommands, WhenAndWhyARunFailedIsInEveryExport) {
  const ScratchFolder scratch;
  const std::string config = study_file(scratch, "fail_every=50 throw_at=3"),
                    out = scratch.file("out");
  ASSERT_EQ(test::synthetic("run " + config + " -o " + out).code, 0);
  for (const char* format : {"csv", "json"})
    ASSERT_EQ(test::synthetic("export " + out + " --format " + format).code, 0);
  const std::string csv = test::text_of(out + "/export.csv");
  expect_says(csv, ",t_failed [s],cause\n");
  expect_says(csv, "0,49,filter_diverged,nan,nan,nan,nan,nan,490,made to fail\n");
  expect_says(csv, "0,3,error,nan,nan,nan,nan,nan,0,thrown by run 3\n");
  const auto failures =
      nlohmann::json::parse(test::text_of(out + "/export.json"))["points"][0]["failures"];
  ASSERT_EQ(failures.size(), 5u);
  EXPECT_EQ(
      failures[1],
      nlohmann::json::parse(
          R"({"run": 49, "status": "filter_diverged", "t_s": 490.0, "cause": "made to fail"})"));
  const Answer hdf5 = test::synthetic("export " + out + " --format hdf5");
  expect_says(hdf5.out, "groups: runs summary failures\n");
}

/// What every command that reads a folder answers.
void expect_all_refuse(const std::string& out, const std::string& words) {
  for (const std::string& line :
       {"status " + out, "verify " + out + " --sample 100%", "export " + out + " --format csv",
        "replay " + out + " --run 1", "report " + out}) {
    const Answer a = test::synthetic(line);
    EXPECT_EQ(a.code, 7) << line << a.out << a.err;
    expect_says(a.err, words);
  }
}

TEST(StoreCommands, NamesAndUnitsOfColumnsAreGuarded) {
  const ScratchFolder scratch;
  const std::string config = study_file(scratch, ""), out = scratch.file("out"),
                    path = out + "/manifest.json";
  const Answer run = test::synthetic("run " + config + " -o " + out);
  const std::string whole = test::text_of(path);
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"made/1", "made/0"}, {"\"arcsec\"", "\"rad\""}}) {
    std::string text = whole;
    text.replace(text.find(from), from.size(), to);
    scratch.write("out/manifest.json", text);
    expect_all_refuse(out, "the file does not fit its checksum");
    // One of the format before, which has no checksum, is compared with the study.
    auto json = nlohmann::ordered_json::parse(text);
    json["format"] = 1;
    json.erase("checksum");
    scratch.write("out/manifest.json", json.dump(1));
    expect_all_refuse(out, "study point 0 has other columns");
  }
  // The way out that the message names.
  EXPECT_EQ(test::synthetic("run " + config + " -o " + out).code, 7);
  fs::rename(path, scratch.file("moved"));
  const Answer again = test::synthetic("run " + config + " -o " + out);
  EXPECT_EQ(again.out, run.out);
  expect_says(again.err, "200 runs stored before, 0 executed");
  EXPECT_EQ(test::synthetic("verify " + out).code, 0);
}

TEST(StoreCommands, ADamagedStudyFileIsMendedByTheSameCommandAndKept) {
  const ScratchFolder scratch;
  const std::string config = study_file(scratch, ""), out = scratch.file("out");
  const Answer run = test::synthetic("run " + config + " -o " + out);
  const std::string whole = test::text_of(out + "/study.toml");
  for (const std::string& damaged : {whole.substr(0, whole.size() / 2), std::string("\xff\xfe"),
                                     whole + "[readout]\ngimbals = false\n"}) {
    scratch.write("out/study.toml", damaged);
    expect_all_refuse(out, "Run the same command again: it is written anew");
    const Answer again = test::synthetic("run " + config + " -o " + out);
    EXPECT_EQ(again.out, run.out) << again.err;
    expect_says(again.err, "study.toml was not that of the study: written anew");
    EXPECT_EQ(test::text_of(out + "/study.toml"), whole);
    EXPECT_EQ(test::text_of(out + "/study.toml.damaged-1"), damaged);
    EXPECT_EQ(test::synthetic("verify " + out).code, 0);
    fs::remove(out + "/study.toml.damaged-1");
  }
}

/// Its runs are part of what it is: read with one run it was another study, and called damaged.
TEST(StoreCommands, AStudyFileOfALatinHypercubeIsNotTakenForDamaged) {
  const ScratchFolder scratch;
  const std::string config = study_file(scratch, ""), out = scratch.file("out");
  const std::string design = " --set monte_carlo.design=latin_hypercube -o " + out;
  const Answer run = test::synthetic("run " + config + design);
  ASSERT_EQ(run.code, 0) << run.err;
  const Answer again = test::synthetic("run " + config + design);
  EXPECT_EQ(again.out, run.out) << again.err;
  for (const Answer& answer : {run, again})
    EXPECT_EQ(answer.err.find("was not that of the study"), std::string::npos) << answer.err;
  EXPECT_FALSE(fs::exists(out + "/study.toml.damaged-1"));
}

/// As a worker leaves it that is stopped between its manifest and its study file.
TEST(StoreCommands, WithoutItsStudyFileTheManifestSaysWhatTheStudyIs) {
  const ScratchFolder scratch;
  const std::string config = study_file(scratch, ""), out = scratch.file("out");
  const Answer run = test::synthetic("run " + config + " -o " + out);
  const std::string whole = test::text_of(out + "/study.toml");
  fs::remove(out + "/study.toml");
  for (const char* command : {"status ", "verify --sample 100% ", "replay --run 1 "}) {
    const Answer answer = test::synthetic(command + out);
    EXPECT_EQ(answer.code, 0) << command << answer.err;
  }
  EXPECT_EQ(test::synthetic("run " + config + " -o " + out).out, run.out);
  EXPECT_EQ(test::text_of(out + "/study.toml"), whole);
}

TEST(StoreCommands, OnlyRunsOfTheStudyAreReplayed) {
  const ScratchFolder scratch;
  const std::string config = study_file(scratch, ""), out = scratch.file("out");
  ASSERT_EQ(test::synthetic("run " + config + " --worker 0/2 -o " + out).code, 0);
  for (const char* run : {"-1", "200", "1e3", "18446744073709551615"}) {
    const Answer answer = test::synthetic("replay " + out + " --run " + std::string(run));
    EXPECT_EQ(answer.code, 2) << run;
    EXPECT_TRUE(answer.err.find("from 0 to") != std::string::npos ||
                answer.err.find("runs 0 to 199") != std::string::npos)
        << answer.err;
  }
  EXPECT_EQ(test::synthetic("replay " + out + " --run 1 --point -1").code, 2);
  const Answer later = test::synthetic("replay " + out + " --run 100");
  EXPECT_EQ(later.code, 0) << later.err;
  expect_says(later.out, "the run is not stored yet");
}

TEST(StoreCommands, AStudyThatItsStopRuleEndedSaysSo) {
  const ScratchFolder scratch;
  const std::string config = study_file(scratch, "half_width=0.09 points=2", "5000"),
                    out = scratch.file("out");
  const Answer run = test::synthetic("run " + config + " -o " + out);
  ASSERT_EQ(run.code, 0) << run.err;
  expect_says(run.out,
              "the stop rule ended 2 of 2 points early, after 192 to 512 of at most 5000 runs");
  const Answer status = test::synthetic("status " + out);
  expect_says(status.out, "2 of 2 points complete");
  expect_says(status.out, "the stop rule ended 2 of 2 points early");
  const Answer verify = test::synthetic("verify " + out + " --sample 0%");
  expect_says(verify.out, " 0 missing");
  expect_says(verify.out, "sound and complete");
  fs::remove(out + "/worker-0000.sqlite");
  EXPECT_EQ(test::synthetic("verify " + out).code, 7);
}

}  // namespace
}  // namespace drift::store_commands_test
