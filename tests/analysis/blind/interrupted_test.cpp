// What ends the program while trials are diagnosed changes no answer, unless it is the diagnosis
// itself.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>

#include "analysis/blind/session/answer_trials.hpp"
#include "analysis/blind/session/seal.hpp"
#include "analysis/blind/session/trial_folder.hpp"
#include "core/base/check.hpp"
#include "tests/support/program.hpp"
#include "tests/support/tiny_blind_study.hpp"

namespace drift::blind::interrupted_test {
namespace {

namespace fs = std::filesystem;
using test::ScratchFolder;
using test::text_of;

/// A sealed folder of three trials, which the solvers below do not even read.
std::string sealed_folder(const ScratchFolder& scratch) {
  for (const char* trial : {"0001", "0002", "0003"}) {
    fs::create_directories(scratch.file("out/trials/" + std::string(trial)));
    scratch.write("out/trials/" + std::string(trial) + "/recording.csv", "");
    scratch.write("out/trials/" + std::string(trial) + "/study.toml", "");
  }
  begin_results(results_in(scratch.file("out")));
  std::string study = test::tiny_blind_study;
  const std::string six = "trials = 6";
  study.replace(study.find(six), six.size(), "trials = 3");
  scratch.write("out/study.toml", study);
  write_sealed(scratch.file("out"), "key.json", "{}");
  return scratch.file("out");
}

Answer named(const std::string&, const std::string&) {
  Answer answer;
  answer.verdict = diagnosis::Verdict::named;
  return answer;
}

/// Diagnoses in a process of its own, in which the second trial ends as `end` does; how that ended.
int status_of(const std::string& folder, const std::function<void()>& end) {
  const pid_t child = fork();
  if (child == 0) {
    answer_trials(folder,
                  [&](const std::string& study, const std::string& recording) {
                    if (study.find("0002") != std::string::npos) end();
                    return named(study, recording);
                  },
                  {1});
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

std::vector<Answer> finished(const std::string& folder) {
  answer_trials(folder, named, {1});
  return answers_of(text_of(folder + "/answers.json"));
}

TEST(BlindInterrupted, KillsAndStopSignalsChangeNoAnswer) {
  for (const int number : {SIGKILL, SIGTERM, SIGINT}) {
    const ScratchFolder scratch;
    const std::string folder = sealed_folder(scratch);
    for (int time = 0; time < 3; ++time) {
      const int status = status_of(folder, [&] { kill(getpid(), number); });
      ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == number);
    }
    for (const Answer& a : finished(folder)) {
      EXPECT_FALSE(a.failed) << a.failure;
      EXPECT_EQ(a.verdict, diagnosis::Verdict::named);
    }
  }
}

[[gnu::noinline]] int endless(int depth) {
  volatile char room[4096] = {};
  room[depth % 4096] = 1;
  return depth < 0 ? 0 : endless(depth + 1) + room[0];
}

TEST(BlindInterrupted, ATrialThatCrashesTwiceIsGivenUpAndSaysHow) {
  const std::pair<const char*, std::function<void()>> crashes[] = {
      {"SIGSEGV", [] { *static_cast<volatile int*>(nullptr) = 1; }},
      {"SIGABRT", [] { std::abort(); }},
      {"SIGSEGV", [] { endless(0); }}};  // no stack is left for the handler either
  for (const auto& [name, crash] : crashes) {
    const ScratchFolder scratch;
    const std::string folder = sealed_folder(scratch);
    for (int time = 0; time < 2; ++time) ASSERT_TRUE(WIFSIGNALED(status_of(folder, crash)));
    const auto answers = finished(folder);
    ASSERT_EQ(answers.size(), 3u);
    for (const Answer& a : answers) EXPECT_EQ(a.failed, a.number == 2);
    EXPECT_EQ(answers[1].failure,
              std::string("the program crashed 2 times while this trial was diagnosed (") + name +
                  ", " + name + ")");
  }
}

TEST(BlindInterrupted, ATrialThatCrashedOnceIsTriedAgain) {
  const ScratchFolder scratch;
  const std::string folder = sealed_folder(scratch);
  ASSERT_TRUE(WIFSIGNALED(status_of(folder, [] { std::abort(); })));
  for (const Answer& a : finished(folder)) EXPECT_FALSE(a.failed);
  EXPECT_FALSE(fs::exists(folder + "/trials/0002/crashes"));
}

TEST(BlindInterrupted, AFullDiskOrTooLittleMemoryIsNoAnswer) {
  const ScratchFolder scratch;
  const std::string folder = sealed_folder(scratch);
  const auto refusing = [](auto error) {
    return [=](const std::string& study, const std::string&) -> Answer {
      if (study.find("0002") != std::string::npos) throw error;
      return {};
    };
  };
  EXPECT_THROW(answer_trials(folder, refusing(InputError(ExitCode::io, "no room")), {1}),
               InputError);
  EXPECT_THROW(answer_trials(folder, refusing(std::bad_alloc()), {1}), std::bad_alloc);
  EXPECT_FALSE(fs::exists(folder + "/trials/0002/answer.json"));
  EXPECT_TRUE(fs::exists(folder + "/trials/0001/answer.json")) << "the others are kept";
  for (const Answer& a : finished(folder)) EXPECT_FALSE(a.failed);
}

TEST(BlindInterrupted, AStopSignalEndsTheProgramWithItsExitCodeAndAWord) {
  const ScratchFolder scratch;
  const std::string out = scratch.file("out"), err = scratch.file("err");
  for (int time = 0; time < 2; ++time) {
    // As soon as it says that the key is sealed the first diagnosis is on its way.
    const std::string line = "rm -f '" + err + "'; '" DRIFT_PROGRAM "' blind " +
                             test::config("blind_small.toml") + " --trials 1 --progress none -o '" +
                             out + "' 2>'" + err + "' & pid=$!; until grep -qs 'Key sealed' '" +
                             err + "'; do sleep 0.05; done; sleep 0.2; kill -TERM $pid; wait $pid";
    const int status = std::system(line.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 143);
    EXPECT_NE(text_of(err).find("the same command goes on"), std::string::npos);
  }
  EXPECT_FALSE(fs::exists(out + "/trials/0001/answer.json"));
  EXPECT_FALSE(fs::exists(out + "/trials/0001/crashes")) << "a caught signal is no crash";
}

}  // namespace
}  // namespace drift::blind::interrupted_test
