// A study with its own term, from simulation to the patched study, as a user runs it.
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"

namespace drift::own_term_commands_test {
namespace {

using namespace drift::test;

/// terms: of the nominal filter.
std::string study(const std::string& terms, const std::string& equation) {
  return "schema = 1\ntitle = \"own term\"\n[site]\nlatitude = \"45.75 deg\"\n"
         "[plan]\npreset = \"six\"\ndwell = \"40 min\"\nsample = \"2 min\"\n"
         "[[term]]\nkey = \"rumble\"\ntitle = \"rumble of a bearing\"\nacts_on = \"drift.y\"\n"
         "parameters = { A = { unit = \"deg/h\", prior = 0.02 }, P = { unit = \"min\", value = 23 "
         "} "
         "}\nequation = \"" +
         equation +
         "\"\n[truth]\ncoupling = \"eq5\"\nterms = [\"fixed_drift\", \"D_I\", \"K0\", \"rumble\"]\n"
         "parameters = { rumble_A = \"0.08 deg/h\" }\n"
         "[[filter]]\nname = \"nominal\"\ncoupling = \"eq5\"\nterms = [" +
         terms + "]\n[monte_carlo]\nruns = 40\nseed = 5\nestimator = \"batch\"\n";
}
const std::string rumble = "A*sin(2*pi*t/P)*(1 + abs(f_x))",
                  all = "\"fixed_drift\", \"D_I\", \"K0\", \"rumble\"",
                  without = "\"fixed_drift\", \"D_I\", \"K0\"";

std::string digest_of(const ScratchFolder& folder, const std::string& out) {
  const Answer verify = driftscope("verify " + folder.file(out));
  EXPECT_EQ(verify.code, 0) << verify.out << verify.err;
  const auto at = verify.out.find("results ");
  return at == std::string::npos ? "" : verify.out.substr(at);
}

TEST(OwnTermCommands, RunsAreTheSameBitsForAnyNumberOfThreadsAndResumed) {
  const ScratchFolder folder;
  const std::string config = folder.write("s.toml", study(all, rumble));
  ASSERT_EQ(driftscope("run " + config + " --threads 1 -o " + folder.file("one")).code, 0);
  const std::string digest = digest_of(folder, "one");
  EXPECT_GT(digest.size(), 20u);
  ASSERT_EQ(driftscope("run " + config + " --threads 2 --runs 7 -o " + folder.file("two")).code, 0);
  ASSERT_EQ(driftscope("run " + config + " --threads 2 -o " + folder.file("two")).code, 0);
  EXPECT_EQ(digest_of(folder, "two"), digest);
  EXPECT_EQ(driftscope("replay " + folder.file("two") + " --run 3").code, 0);
  // Another equation is another study.
  const std::string other = folder.write("o.toml", study(all, "A*cos(2*pi*t/P)"));
  EXPECT_EQ(driftscope("run " + other + " -o " + folder.file("two")).code, store_error);
  // Results are named as the term is.
  ASSERT_EQ(driftscope("export " + folder.file("two") + " --format csv").code, 0);
  bool named = false;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.file("two")))
    named = named || (entry.path().extension() == ".csv" &&
                      text_of(entry.path().string()).find("rumble_A") != std::string::npos);
  EXPECT_TRUE(named);
}

/// It is looked at before it is written anew: its terms are not those of the runs.
TEST(OwnTermCommands, AStudyFileThatWasChangedInTheFolderChangesNoRun) {
  const ScratchFolder folder;
  const std::string sweep = "[sweep]\n\"plan.sample\" = [\"2 min\", \"4 min\"]\n",
                    config = folder.write("s.toml", study(all, rumble) + sweep);
  ASSERT_EQ(driftscope("run " + config + " --threads 1 -o " + folder.file("one")).code, 0);
  ASSERT_EQ(driftscope("run " + config + " --runs 7 -o " + folder.file("two")).code, 0);
  folder.write("two/study.toml", study(all, "A*cos(2*pi*t/P)") + sweep);
  EXPECT_EQ(driftscope("run " + config + " --dry-run -o " + folder.file("two")).code, 0);
  const Answer a = driftscope("run " + config + " -o " + folder.file("two"));
  EXPECT_EQ(a.code, 0) << a.err;
  EXPECT_NE(a.err.find("study.toml was not that of the study"), std::string::npos) << a.err;
  EXPECT_EQ(digest_of(folder, "two"), digest_of(folder, "one"));
}

TEST(OwnTermCommands, WhatIsHiddenIsFoundAndThePatchedStudyHasIt) {
  const ScratchFolder folder;
  const std::string config = folder.write("s.toml", study(without, rumble)),
                    recording = folder.file("r.csv"), out = folder.file("out");
  ASSERT_EQ(driftscope("simulate " + config + " -o " + recording).code, 0);
  const Answer a = driftscope("diagnose " + config + " " + recording + " -o " + out);
  ASSERT_EQ(a.code, 0) << a.err;
  const auto json = nlohmann::json::parse(text_of(out + "/diagnosis.json"));
  ASSERT_EQ(json["verdict"], "named") << a.out;
  EXPECT_EQ(json["causes"][0]["term"], "rumble");
  EXPECT_EQ(json["causes"][0]["parameters"][0]["key"], "rumble_A");
  EXPECT_NEAR(json["causes"][0]["parameters"][0]["value"].get<double>(), 0.08,
              4.0 * json["causes"][0]["parameters"][0]["sigma"].get<double>());
  const Answer found = driftscope("identify " + out + "/patched.toml " + recording + " --full");
  EXPECT_EQ(found.code, 0) << found.err;
  EXPECT_NE(found.out.find("rumble_A"), std::string::npos) << found.out;
}

TEST(OwnTermCommands, TermsListsAndExplainsThem) {
  const ScratchFolder folder;
  const std::string config = " --config " + folder.write("s.toml", study(all, rumble));
  const Answer plain = driftscope("terms"), more = driftscope("terms" + config);
  EXPECT_EQ(plain.out.find("rumble"), std::string::npos);
  EXPECT_NE(more.out.find("w_l,y += " + rumble), std::string::npos) << more.out;
  const Answer one = driftscope("terms rumble_P" + config);
  EXPECT_NE(one.out.find("rumble: rumble of a bearing"), std::string::npos) << one.out;
  EXPECT_NE(one.out.find("known, 23"), std::string::npos) << one.out;
  EXPECT_EQ(driftscope("terms rumble").code, usage_error);
  EXPECT_NE(driftscope("check " + folder.file("s.toml")).out.find("rumble_A"), std::string::npos);
}

/// At a row, at the middle of an interval and elsewhere: told where the plan is looked at, and
/// where runs fail of it.
TEST(OwnTermCommands, APoleIsToldWithItsTermAndTime) {
  for (const std::string pole : {"720", "660", "610"}) {
    const ScratchFolder folder;
    const std::string config =
                          folder.write("s.toml", study(all, "A*sin(2*pi*t/P)/(t - " + pole + ")")),
                      said = "term 'rumble' is no finite number at t = " + pole +
                             " s, in position 1 (expected";
    for (const std::string command : {"check ", "rank ", "simulate -o never.csv "}) {
      const Answer a = driftscope(command + config);
      EXPECT_EQ(a.code, config_error) << command << a.err;
      EXPECT_NE(a.err.find("s.toml:14: " + said), std::string::npos) << a.err;
    }
    const Answer run = driftscope("run " + config + " --runs 4 -o " + folder.file("out"));
    EXPECT_EQ(run.code, static_cast<int>(ExitCode::failed_runs)) << run.err;
    EXPECT_NE(text_of(folder.file("out/report.html")).find("is no finite number at t = " + pole),
              std::string::npos);
    EXPECT_NE(run.out.find("Failed runs: term 'rumble' is no finite number"), std::string::npos)
        << run.out;
  }
}

TEST(OwnTermCommands, AColumnThatNobodyHasIsAskedFor) {
  const ScratchFolder folder;
  const std::string config = folder.write("s.toml", study(all, "A*sin(2*pi*t/P)*pressure"));
  const Answer simulated = driftscope("simulate " + config + " -o " + folder.file("r.csv"));
  EXPECT_EQ(simulated.code, config_error) << simulated.err;
  EXPECT_NE(simulated.err.find("term 'rumble' needs 'pressure'"), std::string::npos)
      << simulated.err;
}

}  // namespace
}  // namespace drift::own_term_commands_test
