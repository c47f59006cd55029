// Trials that several processes share, that are stopped and resumed: the results of one process.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>

#include "analysis/blind/session/answer_trials.hpp"
#include "analysis/blind/session/make_trials.hpp"
#include "analysis/blind/session/seal.hpp"
#include "core/base/sha256.hpp"
#include "mc/store/manifest.hpp"
#include "tests/support/program.hpp"
#include "tests/support/tiny_blind_study.hpp"

namespace drift::blind::shared_trials_test {
namespace {

namespace fs = std::filesystem;
using test::ScratchFolder;
using test::text_of;

/// blind.json without what differs from call to call: the clock and how it was called.
nlohmann::json scores_in(const std::string& folder) {
  auto json = nlohmann::json::parse(text_of(folder + "/blind.json"));
  json.erase("seconds");
  json.erase("provenance");
  for (auto& trial : json.at("scores")) trial.erase("seconds");
  return json;
}

/// The page without the date and the command line at its end.
std::string page_in(const std::string& folder) {
  const std::string text = text_of(folder + "/report.html");
  static const std::regex date("20\\d\\d-\\d\\d-\\d\\dT\\d\\d:\\d\\d:\\d\\dZ"),
      command("[^<>]*driftscope blind [^<>]*");
  return std::regex_replace(std::regex_replace(text, date, "DATE"), command, "COMMAND");
}

void expect_same_results(const std::string& is, const std::string& wanted) {
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(wanted)) {
    const std::string name = fs::relative(entry.path(), wanted).string();
    const std::string file = entry.path().filename().string();
    const bool own = file == "manifest.json" || file == "time.json" || file == "blind.json" ||
                     file == "report.html" || file == ".driftscope" || file.ends_with(".lock");
    if (!entry.is_regular_file() || own) continue;
    EXPECT_EQ(text_of(is + "/" + name), text_of(entry.path().string())) << name;
    ++files;
  }
  EXPECT_GE(files, 4u * 3u + 5u) << "of every trial three, study, key, answers and pictures";
  EXPECT_EQ(scores_in(is), scores_in(wanted));
  EXPECT_EQ(page_in(is), page_in(wanted));
}

/// The study in a scratch folder, and what the program answers about it.
class Shared {
 public:
  std::string out(const std::string& name) const { return scratch_.file(name); }
  test::Answer blind(const std::string& name, const std::string& options = "") const {
    return test::driftscope(line(name, options));
  }
  int status(const std::string& name) const {
    return test::driftscope("status '" + out(name) + "'").code;
  }
  std::string line(const std::string& name, const std::string& options) const {
    return "blind '" + study_ + "' -o '" + out(name) + "' --progress none --threads 1 --trials 4 " +
           options;
  }

 private:
  ScratchFolder scratch_;
  std::string study_ = scratch_.write("blind.toml", test::tiny_blind_study);
};

TEST(SharedTrials, AnyNumberOfWorkersKilledAndResumedGivesTheResultsOfOneProcess) {
  const Shared shared;
  ASSERT_EQ(shared.blind("one").code, 0);
  EXPECT_EQ(shared.status("one"), 0);

  // Two, one after the other: each does its part, the last one writes the results.
  const test::Answer first = shared.blind("two", "--worker 1/2");
  EXPECT_EQ(first.code, 0) << first.err;
  EXPECT_NE(first.err.find("missing: 2 trials of the other workers' parts"), std::string::npos)
      << first.err;
  EXPECT_FALSE(fs::exists(shared.out("two") + "/blind.json"));
  EXPECT_EQ(shared.status("two"), 75);
  EXPECT_EQ(shared.blind("two", "--worker 0/2").code, 0);
  EXPECT_EQ(shared.status("two"), 0);
  expect_same_results(shared.out("two"), shared.out("one"));

  // Three at the same time, killed at moments of all kinds, resumed by two and by one.
  for (const char* moment : {"0.05", "0.3", "0.8"}) {
    std::string line;
    for (const char* share : {"0/3", "1/3", "2/3"})
      line += "timeout -s KILL " + std::string(moment) + " '" DRIFT_PROGRAM "' " +
              shared.line("three", "--worker " + std::string(share)) + " >/dev/null 2>&1 & ";
    EXPECT_NE(std::system((line + "wait").c_str()), -1);
  }
  shared.blind("three", "--worker 1/2");
  EXPECT_EQ(shared.blind("three").code, 0);
  EXPECT_EQ(shared.status("three"), 0);
  expect_same_results(shared.out("three"), shared.out("one"));
}

TEST(SharedTrials, MaxWallEndsResumableAndTheSameCommandFinishes) {
  const Shared shared;
  int stopped = 0, code = 75;
  // Too short at first on any machine, in the end long enough on any.
  double wall = 0.001;
  for (int call = 0; call < 40 && code == 75; ++call, wall *= 2.0) {
    code = shared.blind("out", fmt::format("--max-wall {:.3f}s", wall)).code;
    if (code != 75) break;
    ++stopped;
    EXPECT_EQ(shared.status("out"), 75);
  }
  EXPECT_EQ(code, 0);
  EXPECT_GE(stopped, 1);
  EXPECT_EQ(shared.status("out"), 0);
}

TEST(SharedTrials, AForeignFolderForTheExportIsSaidBeforeTrialsAreMade) {
  const Shared shared;
  std::filesystem::create_directory(shared.out("ex"));
  std::ofstream(shared.out("ex") + "/study.toml") << "mine";
  EXPECT_EQ(shared.blind("out", "--export '" + shared.out("ex") + "'").code, 7);
  EXPECT_FALSE(std::filesystem::exists(shared.out("out")));
}

TEST(SharedTrials, WhatIsGoneOfATrialIsMadeAnewAndComesOutTheSame) {
  const Shared shared;
  ASSERT_EQ(shared.blind("out").code, 0);
  ASSERT_EQ(shared.blind("one").code, 0);
  const std::string trials = shared.out("out") + "/trials", second = trials + "/0002/recording.csv";
  const std::string recording = text_of(second);
  fs::remove_all(trials + "/0002");
  fs::remove(trials + "/0003/answer.json");
  fs::remove(trials + "/0003/study.toml");
  const test::Answer half = test::driftscope("status '" + shared.out("out") + "'");
  EXPECT_EQ(half.code, 75);
  EXPECT_NE(half.out.find("2 of 4 trials made"), std::string::npos) << half.out;
  const test::Answer again = shared.blind("out");
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(text_of(second), recording);
  expect_same_results(shared.out("out"), shared.out("one"));
  EXPECT_EQ(shared.status("out"), 0);
}

TEST(SharedTrials, ARecordingThatIsNeededNoMoreIsMadeForWhoeverAnswersItAnew) {
  const Shared shared;
  ASSERT_EQ(shared.blind("out").code, 0);
  const std::string path = shared.out("out") + "/trials/0002/recording.csv",
                    recording = text_of(path);
  fs::remove(path);
  EXPECT_EQ(shared.blind("out").code, 0);
  EXPECT_FALSE(fs::exists(path));
  EXPECT_EQ(shared.blind("out", "--export '" + shared.out("ex") + "'").code, 0);
  EXPECT_EQ(text_of(shared.out("ex") + "/trials/0002/recording.csv"), recording);
}

TEST(SharedTrials, ARecordingThatIsNotWhatTheKeySaysIsNotTaken) {
  const Shared shared;
  ASSERT_EQ(shared.blind("out").code, 0);
  const std::string out = shared.out("out");
  fs::remove_all(out + "/trials/0002");
  std::string key = text_of(out + "/key.json");
  const std::string there = "\"trial\": 2";
  ASSERT_NE(key.find(there), std::string::npos) << key.substr(0, 400);
  key.replace(key.find("\"total_size\": ", key.find(there)) + 14, 0, "1");
  std::ofstream(out + "/key.json", std::ios::binary) << key;
  std::ofstream(out + "/key.sha256", std::ios::binary) << sha256_hex(key) << "  key.json\n";
  const test::Answer again = shared.blind("out");
  EXPECT_EQ(again.code, 8) << again.err;
  EXPECT_NE(again.err.find("is not what the key says"), std::string::npos) << again.err;
}

TEST(SharedTrials, SealedAnswersThatAreGoneAreMadeAnewAndAGoneKeyIsSaid) {
  const Shared shared;
  ASSERT_EQ(shared.blind("out").code, 0);
  const std::string path = shared.out("out") + "/answers.json", text = text_of(path);
  fs::remove(path);
  const test::Answer told = test::driftscope("status '" + shared.out("out") + "'");
  EXPECT_EQ(told.code, 8);
  EXPECT_NE(told.err.find("answers.json: is gone"), std::string::npos) << told.err;
  EXPECT_EQ(shared.blind("out").code, 0);
  EXPECT_EQ(text_of(path), text);
  fs::remove(shared.out("out") + "/key.json");
  const test::Answer key = shared.blind("out");
  EXPECT_EQ(key.code, 8);
  EXPECT_NE(key.err.find("key.json: is gone"), std::string::npos) << key.err;
}

TEST(SharedTrials, AnAnswerThatCannotBeReadIsNamed) {
  const Shared shared;
  ASSERT_EQ(shared.blind("out").code, 0);
  std::ofstream(shared.out("out") + "/trials/0003/answer.json") << "{\"trial\": 3,";
  const test::Answer told = test::driftscope("status '" + shared.out("out") + "'");
  EXPECT_EQ(told.code, 8);
  EXPECT_NE(told.err.find("trials/0003/answer.json: no answer can be read"), std::string::npos)
      << told.err;
}

TEST(SharedTrials, AnswersThatWereChangedAreNoResult) {
  const Shared shared;
  ASSERT_EQ(shared.blind("out", "").code, 0);
  const std::string path = shared.out("out") + "/answers.json";
  std::string text = text_of(path);
  text[text.size() / 2] ^= 1;
  std::ofstream(path, std::ios::binary) << text;
  EXPECT_EQ(shared.status("out"), 8);
}

TEST(SharedTrials, OneProcessAtATimeIsAWorker) {
  const Shared shared;
  const std::string command = "'" DRIFT_PROGRAM "' " + shared.line("out", "--worker 0/2");
  // The first is held up by a signal; the second gives up after its patience.
  const int begun = std::system(
      (command + " >/dev/null 2>&1 & pid=$!; until [ -e '" + shared.out("out") +
       "/trials/worker-0000.lock' ]; do sleep 0.02; done; sleep 0.05; kill -STOP $pid; " + command +
       " >/dev/null 2>'" + shared.out("said") + "'; echo $? >'" + shared.out("code") +
       "'; kill -CONT $pid; wait $pid")
          .c_str());
  EXPECT_NE(begun, -1);
  EXPECT_EQ(text_of(shared.out("code")), "7\n");
  EXPECT_NE(text_of(shared.out("said")).find("another process is at work as this worker"),
            std::string::npos)
      << text_of(shared.out("said"));
}

TEST(SharedTrials, WhatIsSealedKnowsNoClock) {
  Answer quick, slow;
  quick.seconds = 0.1;
  slow.seconds = 100.0;
  EXPECT_EQ(to_json(std::vector{quick}), to_json(std::vector{slow}));

  const Shared shared;
  ASSERT_EQ(shared.blind("out").code, 0);
  EXPECT_EQ(text_of(shared.out("out") + "/answers.json").find("seconds"), std::string::npos);
  const auto scores = score_folder(shared.out("out"));
  ASSERT_EQ(scores.size(), 4u);
  for (const TrialScore& s : scores) EXPECT_GT(s.answer.seconds, 0.0) << "known all the same";
}

TEST(SharedTrials, NothingIsSealedBeforeAllTrialsAreMade) {
  const ScratchFolder scratch;
  const mc::Study study = mc::read_study(scratch.write("blind.toml", test::tiny_blind_study));
  const std::string folder = scratch.file("out");
  EXPECT_EQ(make_trials(study, folder, {1, {}, mc::WallTime(0.0)}), std::nullopt);
  EXPECT_EQ(published_hash(folder, "key.json"), "");
  EXPECT_EQ(trials_state(folder).made, 1u) << "however short the time, one";
  const auto hash = make_trials(study, folder, {1, {2, 3}});
  ASSERT_TRUE(hash) << "a worker makes what the others have not made";
  EXPECT_FALSE(fs::exists(folder + "/making"));
  EXPECT_EQ(hash, make_trials(study, scratch.file("whole"), {2}));
}

TEST(SharedTrials, AHalfMadeTrialThatWasChangedIsNotSealed) {
  const ScratchFolder scratch;
  const mc::Study study = mc::read_study(scratch.write("blind.toml", test::tiny_blind_study));
  const std::string folder = scratch.file("out");
  const auto hash = make_trials(study, folder, {1}).value();
  fs::remove(folder + "/key.sha256");
  fs::create_directories(folder + "/making");
  scratch.write("out/making/0002.json", text_of(folder + "/key.json"));
  EXPECT_THROW(make_trials(study, folder, {1}), InputError);
  fs::remove(folder + "/making/0002.json");
  EXPECT_EQ(make_trials(study, folder, {1}), hash);
}

TEST(SharedTrials, AFolderOfAProgramWithOtherArithmeticIsRefused) {
  const ScratchFolder scratch;
  const mc::Study study = mc::read_study(scratch.write("blind.toml", test::tiny_blind_study));
  const std::string folder = scratch.file("out");
  open_trials(study, folder);
  const std::string path = folder + "/trials/manifest.json";
  auto json = nlohmann::ordered_json::parse(text_of(path));
  json["arithmetic"] = "another";
  json.erase("checksum");
  json["format"] = 1;  // which had no checksum
  std::ofstream(path) << json.dump(1);
  EXPECT_THROW(open_trials(study, folder), InputError);
}

}  // namespace
}  // namespace drift::blind::shared_trials_test
