// What is written of several recordings of one unit, and of one run of a study.
#include <filesystem>

#include "tests/support/program.hpp"
#include "tests/support/short_study.hpp"

namespace drift::several_recordings_test {
namespace {

using namespace drift::test;
namespace fs = std::filesystem;

TEST(SeveralRecordings, AreAllWrittenAndEveryResidualSaysOfWhichItIs) {
  const ScratchFolder folder;
  const std::string file = folder.write("s.toml", short_study), out = folder.file("out");
  std::string recordings;
  for (const char* run : {"0", "1"}) {
    const std::string path = folder.file("r" + std::string(run) + ".csv");
    ASSERT_EQ(driftscope("simulate " + file + " -o " + path + " --run " + run).code, 0);
    recordings += " " + path;
  }
  const auto identify = [&](const std::string& files) {
    const Answer a = driftscope("identify " + file + " " + files + " --progress none -o " + out);
    EXPECT_EQ(a.code, 0) << a.err;
  };
  const auto there = [&](const char* name) { return fs::exists(fs::path(out) / name); };
  identify(folder.file("r0.csv"));
  EXPECT_TRUE(there("recording.csv"));
  identify(recordings);
  EXPECT_FALSE(there("recording.csv")) << "that of the call before";
  EXPECT_TRUE(there("recording_1.csv") && there("recording_2.csv"));
  const std::string residuals = text_of(out + "/residuals.csv");
  EXPECT_NE(residuals.find(",scalars,recording\n"), std::string::npos);
  EXPECT_NE(residuals.find(",1\n"), std::string::npos);
  EXPECT_NE(residuals.find(",2\n"), std::string::npos);
  identify(folder.file("r1.csv"));
  EXPECT_TRUE(there("recording.csv"));
  EXPECT_FALSE(there("recording_1.csv") || there("recording_2.csv"));
}

TEST(SeveralRecordings, ThatOneOfThemLacksWhatATermNeedsIsSaidOfThatOne) {
  const ScratchFolder folder;
  const std::string study = std::string(short_study) +
                            "[[filter]]\nname = \"warm\"\ncoupling = \"eq5\"\n"
                            "terms = [\"fixed_drift\", \"accelerometer_temperature\"]\n";
  const std::string cold = folder.write("cold.toml", study),
                    warm = folder.write("warm.toml",
                                        study + "[environment]\ntemperature = \"20 degC\"\n"),
                    with = folder.file("with.csv"), without = folder.file("without.csv");
  ASSERT_EQ(driftscope("simulate " + warm + " -o " + with).code, 0);
  ASSERT_EQ(driftscope("simulate " + cold + " -o " + without + " --run 1").code, 0);
  const auto refused = [&](const std::string& files) {
    const Answer a = driftscope("identify " + cold + " " + files + " --progress none");
    EXPECT_EQ(a.code, 4) << a.err;
    return a.err;
  };
  EXPECT_NE(refused(with + " " + without).find("the temperature, which is not known in " + without),
            std::string::npos);
  EXPECT_NE(refused(without).find("the temperature, which is not known (expected"),
            std::string::npos);
}

TEST(SeveralRecordings, ACompensatedFilterIsRefusedOneThatDoesNotTellWhatTheLoopRemoved) {
  const ScratchFolder folder;
  const std::string filter = "[[filter]]\nname = \"loop\"\ncoupling = \"compensated\"\n";
  const std::string study = folder.write("s.toml", short_study + filter),
                    with = folder.file("with.csv"), without = folder.file("without.csv");
  // No [truth.loop]: the loop removes nothing, and the recording says so.
  ASSERT_EQ(
      driftscope("simulate " + study + " -o " + with + " --set truth.coupling=compensated").code,
      0);
  ASSERT_EQ(driftscope("simulate " + study + " -o " + without + " --run 1").code, 0);
  EXPECT_EQ(driftscope("identify " + study + " " + with + " --progress none").code, 0);
  for (const std::string& files : {without, with + " " + without}) {
    const Answer a = driftscope("identify " + study + " " + files + " --progress none");
    EXPECT_EQ(a.code, 4) << a.err;
    EXPECT_NE(a.err.find("not known in " + without + " (expected columns loop_eta_x"),
              std::string::npos)
        << a.err;
  }
}

TEST(SeveralRecordings, OfACaseAreRefusedAsTheHelpSays) {
  const std::string study = test::config("strapdown_xsens.toml");
  for (const char* command : {"identify ", "diagnose "}) {
    const Answer a = driftscope(command + study + " a.csv b.csv");
    EXPECT_EQ(a.code, usage_error) << a.err;
    EXPECT_NE(a.err.find("a strapdown study takes one recording, 2 are given"), std::string::npos)
        << a.err;
    const std::string help = driftscope(std::string(command) + "--help").out;
    EXPECT_NE(help.find("of a strapdown study one alone"), std::string::npos) << help;
  }
}

TEST(TracedRun, SaysWhoseCourseItIs) {
  const ScratchFolder folder;
  const std::string file = folder.write("s.toml", short_study);
  for (const char* estimator : {"ekf", "iterated"}) {
    const std::string out = folder.file(estimator), trace = folder.file("t.csv");
    ASSERT_EQ(driftscope("run " + file + " -o " + out +
                         " --runs 4 --quiet --set monte_carlo.estimator=" + estimator)
                  .code,
              0);
    const Answer a = driftscope("replay " + out + " --run 1 --trace " + trace);
    ASSERT_EQ(a.code, 0) << a.err;
    EXPECT_EQ(a.out.find("of the EKF from the same starts") != std::string::npos,
              estimator == std::string("iterated"))
        << a.out;
    fs::remove(trace);
  }
}

}  // namespace
}  // namespace drift::several_recordings_test
