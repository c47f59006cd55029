// `driftscope rank` as a user runs it.
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/check.hpp"
#include "tests/support/program.hpp"
// After it: this one opens drift::testing, where program.hpp means ::testing.
#include "tests/analysis/report/xml_check.hpp"

namespace drift::rank_command_test {
namespace {

using namespace drift::test;
using Json = nlohmann::json;

constexpr const char* head = R"(schema = 1
title  = "rank <me>"
[site]
latitude = "45.75 deg"
)";
constexpr const char* plan = R"([plan]
preset = "six"
dwell  = "10 min"
sample = "60 s"
mode   = "level"
)";
constexpr const char* tail = R"([truth]
coupling = "eq5"
[truth.parameters]
D_I_z = "1.45 deg/h/g"
[[filter]]
name     = "corrected"
coupling = "eq5"
[[filter]]
name     = "legacy"
coupling = "eq6"
)";

std::string study(const std::string& positions = plan) {
  return head + positions + tail;
}

Json parsed(const Answer& a) {
  EXPECT_EQ(a.code, 0) << a.err;
  return Json::parse(a.out);
}

TEST(RankCommand, RanksBothEquationsSideBySide) {
  const ScratchFolder folder;
  const std::string file = folder.write("s.toml", study());
  const Answer text = driftscope("rank --full '" + file + "'");
  ASSERT_EQ(text.code, 0) << text.err;
  for (const char* part : {"Ranking for corrected, legacy", "eq5", "eq6",
                           "D_F_x - D_II_x - D_OO_x - D_SS_x", "PWCS: rank 36 of 63"})
    EXPECT_NE(text.out.find(part), std::string::npos) << part << "\n" << text.out;
  const Answer brief = driftscope("rank '" + file + "'");
  for (const char* part : {"Seen under eq5 (filter corrected)", "Under eq6 (filter legacy)"})
    EXPECT_NE(brief.out.find(part), std::string::npos) << part << "\n" << brief.out;
  const Json json = parsed(driftscope("rank '" + file + "' --json"));
  ASSERT_EQ(json["filters"].size(), 1u);  // same terms and priors: one group
  ASSERT_EQ(json["filters"][0]["models"].size(), 2u);
  for (const Json& model : json["filters"][0]["models"]) {
    EXPECT_TRUE(model["of_the_file"].get<bool>());
    ASSERT_EQ(model["parameters"].size(), 60u);
    double last = 0.0, bits = 0.0;
    for (const Json& p : model["parameters"]) {
      EXPECT_GE(p["learning_ratio"].get<double>(), last);
      last = p["learning_ratio"].get<double>();
      EXPECT_NEAR(p["posterior_sigma"].get<double>(), last * p["prior_sigma"].get<double>(),
                  1e-9 * p["prior_sigma"].get<double>());
      if (p["key"] == "D_I_z") {
        EXPECT_DOUBLE_EQ(p["nominal"].get<double>(), 1.45);
      }
    }
    EXPECT_LE(last, 1.0 + 1e-12);
    for (const Json& p : model["information"]["positions"]) bits += p["bits"].get<double>();
    EXPECT_NEAR(bits, model["bits"].get<double>(), 1e-6);
  }
}

/// Ranks, proposes, pastes what is proposed, ranks again: sigmas are as promised.
void paste_and_rank(const std::string& before_paste, bool preset, const std::string& criterion) {
  const ScratchFolder folder;
  const std::string first = folder.write("a.toml", study(before_paste));
  const Json promise =
      parsed(driftscope("rank '" + first + "' --json --progress none --improve 2 --criterion " +
                        criterion))["improvement"];
  ASSERT_EQ(promise["steps"].size(), 2u);
  const std::string proposed = promise["toml"].get<std::string>();
  const std::string second =
      folder.write("b.toml", study((preset ? "[plan]\n" : before_paste) + proposed));
  const Json ranked = parsed(driftscope("rank '" + second + "' --json"));
  EXPECT_NEAR(ranked["plan"]["hours"].get<double>(),
              parsed(driftscope("rank '" + first + "' --json"))["plan"]["hours"].get<double>() +
                  promise["hours_added"].get<double>(),
              1e-9);
  int better = 0;
  for (const Json& p : ranked["filters"][0]["models"][0]["parameters"]) {
    const Json& sigma = promise["sigma"][p["key"].get<std::string>()];
    EXPECT_NEAR(p["posterior_sigma"].get<double>() / sigma["after"].get<double>(), 1.0, 0.01)
        << p["key"];
    EXPECT_LE(sigma["after"].get<double>(), sigma["before"].get<double>() * (1.0 + 1e-9));
    better += sigma["after"].get<double>() < 0.9 * sigma["before"].get<double>();
  }
  EXPECT_GT(better, 5);
}

TEST(RankCommand, SaysWherePromisesDependOnTheTruth) {
  // Level, eq. (5): nearly linear. Free drift under eq. (6): misalignment times drift.
  const ScratchFolder scratch;
  const std::string free = R"([plan]
preset = "six"
dwell  = "60 min"
sample = "10 min"
mode   = "free"
)";
  const Json rank = Json::parse(
      run_program(DRIFT_PROGRAM, "rank --json " + scratch.write("free.toml", study(free))).out);
  const auto factor = [&](const Json& model, const std::string& key) {
    for (const Json& p : model["parameters"])
      if (p["key"] == key)
        return p["learning_ratio_at_drawn_truths"][1].get<double>() /
               p["learning_ratio"].get<double>();
    return 0.0;
  };
  const Json& models = rank["filters"][0]["models"];
  EXPECT_NEAR(factor(models[0], "D_O_x"), 1.0, 0.2);
  EXPECT_GT(factor(models[1], "D_O_x"), 3.0);
}

TEST(RankCommand, ProposedPositionsKeepTheirPromiseWhenPastedForAPreset) {
  paste_and_rank(plan, true, "A");
}

TEST(RankCommand, ProposedPositionsKeepTheirPromiseWhenPastedBehindSlews) {
  paste_and_rank(R"([plan]
dwell  = "10 min"
sample = "60 s"
entry  = "torqued"
[[plan.position]]
name = "added 1: \"mine\""
axes = "x=N y=W z=U"
[[plan.position]]
axes = "x=N y=U z=E"
mode = "level"
)",
                 false, "eta_z");
}

TEST(RankCommand, WritesAFolderThatStandsAlone) {
  const ScratchFolder folder;
  const std::string file = folder.write("s.toml", study());
  const Answer a =
      driftscope("rank '" + file + "' --improve 1 --progress none -o '" + folder.file("out") + "'");
  ASSERT_EQ(a.code, 0) << a.err;
  const std::string page = text_of(folder.file("out/report.html"));
  EXPECT_NE(page.find("rank &lt;me&gt;"), std::string::npos);
  EXPECT_EQ(page.find("rank <me>"), std::string::npos);
  EXPECT_EQ(page.find("<script"), std::string::npos);
  for (const char* name : {"learning.svg", "spectrum.svg", "positions.svg", "improvement.svg"})
    EXPECT_EQ(drift::test::xml_problem(text_of(folder.file(std::string("out/") + name))),
              std::nullopt)
        << name;
  EXPECT_EQ(Json::parse(text_of(folder.file("out/rank.json")))["improvement"]["criterion"], "A");
  EXPECT_NE(text_of(folder.file("out/proposed_positions.toml")).find("[[plan.position]]"),
            std::string::npos);
}

TEST(RankCommand, DoesNotDependOnThreads) {
  const ScratchFolder folder;
  const std::string file = folder.write("s.toml", study());
  const std::string line =
      "rank '" + file + "' --json --progress none --improve 1 --set plan.entry=torqued --threads ";
  Json one = parsed(driftscope(line + "1")), three = parsed(driftscope(line + "3"));
  for (const char* key : {"version", "commit", "compiler", "instruction_set"})
    EXPECT_FALSE(one["provenance"][key].get<std::string>().empty()) << key;
  for (Json* json : {&one, &three}) json->erase("provenance");  // has the command line
  EXPECT_EQ(one.dump(), three.dump());
}

TEST(RankCommand, SaysWhatIsWrongWithWhatItIsAsked) {
  const ScratchFolder folder;
  const std::string file = folder.write("s.toml", study());
  const int usage = static_cast<int>(ExitCode::usage), config = static_cast<int>(ExitCode::config);
  const Answer unknown = driftscope("rank '" + file + "' --improve 1 --criterion eta_w");
  EXPECT_EQ(unknown.code, usage);
  EXPECT_NE(unknown.err.find("eta_w"), std::string::npos);
  EXPECT_EQ(driftscope("rank '" + file + "' --criterion A").code, usage);  // of what?
  EXPECT_EQ(driftscope("rank '" + file + "' --improve 0").code, usage);
  EXPECT_EQ(driftscope("rank '" + folder.file("none.toml") + "'").code, config);
  EXPECT_EQ(driftscope("rank " + test::config("strapdown_xsens.toml")).code, config);
  const std::string unfiltered = study().substr(0, study().find("[[filter]]"));
  EXPECT_EQ(driftscope("rank '" + folder.write("f.toml", unfiltered) + "'").code, config);
  EXPECT_EQ(driftscope("rank '" + file + "' -o /dev/null/out").code,
            static_cast<int>(ExitCode::io));
}

/// A filter of drifts and of one term more.
std::string study_with(const std::string& term, const std::string& own = "") {
  return std::string(head) + plan + own +
         "[[filter]]\nname = \"f\"\ncoupling = \"eq5\"\nterms = [\"fixed_drift\", \"" + term +
         "\"]\n";
}

/// As identify and diagnose do, and with the remark of theirs.
TEST(RankCommand, TakesTheFieldOfADipoleWhereNoneIsDeclared) {
  const ScratchFolder folder;
  const std::string line =
      "rank '" + folder.write("s.toml", study_with("magnetic_drift")) + "' --json";
  const Json assumed = parsed(driftscope(line));
  const Json& field = assumed["assumed_field_gauss"];
  ASSERT_EQ(field.size(), 3u);
  EXPECT_NEAR(field[0].get<double>(), 0.298 * std::cos(45.75 * M_PI / 180.0), 1e-12);
  EXPECT_NEAR(field[2].get<double>(), -0.596 * std::sin(45.75 * M_PI / 180.0), 1e-12);
  EXPECT_NE(assumed["headlines"].dump().find("that of a dipole is taken, 0.208 gauss North and "
                                             "-0.427 gauss Up"),
            std::string::npos);
  std::string sets;
  for (std::size_t k = 0; k < 3; ++k)
    sets +=
        std::string(" --set 'environment.field_") + "nwu"[k] + "=" + field[k].dump() + " gauss'";
  const Json declared = parsed(driftscope(line + sets));
  EXPECT_TRUE(declared["assumed_field_gauss"].is_null());
  EXPECT_EQ(declared["headlines"].dump().find("dipole"), std::string::npos);
  const Json &here = assumed["filters"][0]["models"][0]["parameters"],
             &there = declared["filters"][0]["models"][0]["parameters"];
  ASSERT_EQ(here.size(), there.size());
  bool learned = false;
  for (std::size_t k = 0; k < here.size(); ++k) {
    const double ratio = here[k]["learning_ratio"].get<double>();
    // The field declared is read from 17 digits and a unit: a rounding or two from the other.
    EXPECT_NEAR(there[k]["learning_ratio"].get<double>(), ratio, 1e-6 * ratio);
    learned = learned || (here[k]["key"].get<std::string>().starts_with("M_") && ratio < 0.9);
  }
  EXPECT_TRUE(learned);
}

TEST(RankCommand, SaysOfAFilterThatOnlyARecordingCanFeedThatTheStudyIsWrong) {
  const ScratchFolder folder;
  const std::string own =
      "[[term]]\nkey = \"own\"\nacts_on = \"accelerometer.x\"\nequation = \"A*oil\"\n"
      "parameters = { A = { unit = \"ug\", prior = 100 } }\n";
  for (const auto& [text, what] :
       {std::pair{study_with("own", own), "term 'own' needs 'oil'"},
        std::pair{study_with("temperature_drift"), "term 'temperature_drift' needs the"}}) {
    const std::string file = folder.write("s.toml", text);
    EXPECT_EQ(driftscope("check '" + file + "'").code, 0) << "a recording may have it";
    const Answer a = driftscope("rank '" + file + "'");
    EXPECT_EQ(a.code, config_error) << a.err;
    for (const char* part : {what, "filter.f: ", "planned test"})
      EXPECT_NE(a.err.find(part), std::string::npos) << part << "\n" << a.err;
  }
}

TEST(Tasks, ThatKnowNothingOfEachOtherAreRefusedByEveryCommandThatWrites) {
  const ScratchFolder scratch;
  const std::string recording = scratch.file("r.csv"), out = scratch.file("out"),
                    study = config("cheap.toml");
  ASSERT_EQ(driftscope("simulate " + study + " -o " + recording).code, 0);
  for (const char* launch :
       {"SLURM_STEP_NUM_TASKS=2 SLURM_PROCID=1", "OMPI_COMM_WORLD_SIZE=2", "PMI_SIZE=4 PMI_RANK=1"})
    for (const std::string& line :
         {"rank " + study + " --improve 1 -o " + out, "rank " + study + " --improve 1",
          "rank " + study + " -o " + out, "identify " + study + " -o " + out,
          "diagnose " + study + " " + recording + " -o " + out,
          "blind " + config("blind_small.toml") + " --trials 1 -o " + out}) {
      const Answer a = run_program("env", std::string(launch) + " '" DRIFT_PROGRAM "' " + line);
      EXPECT_EQ(a.code, usage_error) << launch << " " << line;
      EXPECT_NE(a.err.find("tasks that know nothing of each other"), std::string::npos) << a.err;
      EXPECT_FALSE(std::filesystem::exists(out)) << line;
    }
  // Started by the launcher of another MPI, so that this one knows of one process alone.
  const Answer other = run_program(
      "env", "PMI_SIZE=4 PMI_RANK=1 '" DRIFT_PROGRAM "' run " + study + " --runs 64 -o " + out);
  EXPECT_EQ(other.code, usage_error) << other.err;
  const bool mpi = driftscope("version").out.find("\nMPI ") != std::string::npos;
  EXPECT_NE(other.err.find(mpi ? "mpiexec has started 4 tasks" : "built without MPI"),
            std::string::npos)
      << other.err;
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace drift::rank_command_test
