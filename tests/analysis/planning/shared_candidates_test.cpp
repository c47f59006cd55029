// The candidates of `rank --improve`, shared by several processes, stopped and resumed: the results
// of one process.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>

#include "analysis/planning/shared_steps.hpp"
#include "core/base/check.hpp"
#include "tests/support/program.hpp"

namespace drift::planning::shared_candidates_test {
namespace {

namespace fs = std::filesystem;
using test::ScratchFolder;
using test::text_of;

constexpr const char* study = R"(schema = 1
[site]
latitude = "45.75 deg"
[plan]
preset = "slew12"
dwell  = "10 min"
sample = "300 s"
[[filter]]
name     = "nominal"
coupling = "eq5"
terms    = ["fixed_drift", "g_drift"]
)";

/// Two positions to add: the second is judged on what the first has become.
class Shared {
 public:
  std::string out(const std::string& name) const { return scratch_.file(name); }
  test::Answer rank(const std::string& name, const std::string& options = "") const {
    return test::driftscope(line(name, options));
  }
  int status(const std::string& name) const {
    return test::driftscope("status '" + out(name) + "'").code;
  }
  std::string line(const std::string& name, const std::string& options) const {
    return "rank '" + file_ + "' --improve 2 -o '" + out(name) + "' --progress none --threads 1 " +
           options;
  }

 private:
  ScratchFolder scratch_;
  std::string file_ = scratch_.write("plan.toml", study);
};

std::string page_in(const std::string& folder) {
  static const std::regex date("20\\d\\d-\\d\\d-\\d\\dT\\d\\d:\\d\\d:\\d\\dZ"),
      command("[^<>]*driftscope rank [^<>]*");
  std::string page = std::regex_replace(
      std::regex_replace(text_of(folder + "/report.html"), date, "DATE"), command, "COMMAND");
  // What to go on with lies in the folder, too.
  for (std::size_t at; (at = page.find(folder)) != std::string::npos;)
    page.replace(at, folder.size(), "FOLDER");
  return page;
}

nlohmann::json ranking_in(const std::string& folder) {
  auto json = nlohmann::json::parse(text_of(folder + "/rank.json"));
  json.erase("provenance");
  return json;
}

void expect_same_results(const std::string& is, const std::string& wanted) {
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(wanted)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".svg") || name.ends_with(".toml") || name.ends_with(".csv")) {
      EXPECT_EQ(text_of(is + "/" + name), text_of(entry.path().string())) << name;
      ++files;
    }
  }
  EXPECT_GE(files, 1u);
  EXPECT_EQ(ranking_in(is), ranking_in(wanted));
  EXPECT_EQ(page_in(is), page_in(wanted));
}

TEST(SharedCandidates, AnyNumberOfWorkersKilledAndResumedGivesTheResultsOfOneProcess) {
  const Shared shared;
  ASSERT_EQ(shared.rank("one").code, 0);
  EXPECT_EQ(shared.status("one"), 0);
  EXPECT_FALSE(fs::exists(shared.out("one") + "/candidates")) << "nothing is shared unasked";
  for (const char* moment : {"0.1", "0.4", "30"}) {
    std::string line;
    for (const char* share : {"0/3", "1/3", "2/3"})
      line += "timeout -s KILL " + std::string(moment) + " '" DRIFT_PROGRAM "' " +
              shared.line("many", "--worker " + std::string(share)) + " >/dev/null 2>&1 & ";
    EXPECT_NE(std::system((line + "wait").c_str()), -1);
  }
  EXPECT_EQ(shared.status("many"), 0);
  expect_same_results(shared.out("many"), shared.out("one"));
  const test::Answer last = shared.rank("many");
  EXPECT_EQ(last.code, 0) << last.err;
  expect_same_results(shared.out("many"), shared.out("one"));
}

TEST(SharedCandidates, MaxWallEndsResumableAndTheSameCommandFinishes) {
  const Shared shared;
  int stopped = 0, code = 75;
  // Too short at first on any machine, in the end long enough on any.
  double wall = 0.001;
  for (int call = 0; call < 40 && code == 75; ++call, wall *= 2.0) {
    const test::Answer answer = shared.rank("out", fmt::format("--max-wall {:.3f}s", wall));
    code = answer.code;
    if (code != 75) break;
    EXPECT_NE(answer.err.find("candidates are judged and kept"), std::string::npos) << answer.err;
    EXPECT_EQ(shared.status("out"), 75);
    ++stopped;
  }
  EXPECT_EQ(code, 0);
  EXPECT_GE(stopped, 1);
  EXPECT_EQ(shared.status("out"), 0);
}

TEST(SharedCandidates, TheFolderIsThatOfOneCriterionAndAMistypedOneWritesNothing) {
  const Shared shared;
  EXPECT_EQ(shared.rank("out", "--worker 0/2 --criterion D_I_w").code, test::usage_error);
  EXPECT_FALSE(fs::exists(shared.out("out")));
  EXPECT_EQ(shared.rank("out", "--worker 0/2 --criterion D_I_x").code, 0);
  const test::Answer other = shared.rank("out", "--worker 0/2 --criterion D_I_y");
  EXPECT_EQ(other.code, test::store_error);
  EXPECT_NE(other.err.find("--criterion D_I_y"), std::string::npos) << other.err;
}

TEST(SharedCandidates, WorkersNeedSomethingToShare) {
  const Shared shared;
  const ScratchFolder scratch;
  const std::string file = scratch.write("plan.toml", study);
  EXPECT_EQ(test::driftscope("rank '" + file + "' --worker 0/2").code, test::usage_error);
  EXPECT_EQ(test::driftscope("rank '" + file + "' --improve 1 --max-wall 1h").code,
            test::usage_error);
}

/// Worth of candidates that nothing is integrated for; every third is impossible.
std::optional<double> worth(std::size_t k) {
  if (k % 3 == 0) return std::nullopt;
  return k == 5 ? -HUGE_VAL : -1.0 / static_cast<double>(k);
}

TEST(SharedCandidates, WhatOneWorkerJudgedNoOtherJudgesAgain) {
  const ScratchFolder scratch;
  const std::string folder = scratch.file("candidates");
  const mc::Manifest manifest = steps_manifest({"text", 1, 1}, "schema = 1\n", 2, "A");
  mc::claim_folder(folder, manifest);
  constexpr std::size_t n = 20;
  Merits wanted;
  for (std::size_t k = 0; k < n; ++k) wanted.push_back(worth(k));
  {
    SharedSteps stopped(folder, manifest, {1, {1, 2}, mc::WallTime(0.05)});
    EXPECT_EQ(stopped.judge(0, n,
                            [](std::size_t k) {
                              EXPECT_EQ(k % 2, 1u) << "its own part first";
                              usleep(20000);
                              return worth(k);
                            }),
              std::nullopt);
    EXPECT_GE(stopped.judged(), 1u);
    stopped.end(ExitCode::wall_time);
    EXPECT_EQ(mc::read_manifest(folder).finished, 0u);
    SharedSteps second(folder, manifest, {2, {0, 2}});
    EXPECT_EQ(second.judge(0, n, worth), wanted);
    EXPECT_EQ(second.judged() + stopped.judged(), n);
    second.end(ExitCode::ok);
    EXPECT_EQ(mc::read_manifest(folder).finished, n);
  }
  SharedSteps third(folder, manifest, {});
  EXPECT_EQ(third.judge(0, n, worth), wanted);
  EXPECT_EQ(third.judged(), 0u);
  EXPECT_EQ(third.judge(1, n, worth), wanted) << "another step";
  EXPECT_EQ(third.judged(), n);
}

}  // namespace
}  // namespace drift::planning::shared_candidates_test
