// Positions of a plan that have each a sample of their own, read back from a file.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/log_edits.hpp"
#include "tests/support/program.hpp"

namespace drift::own_samples_test {
namespace {

using namespace drift::test;

/// The second position has a few long samples, the third many short ones.
constexpr const char* study = R"(schema = 1
[site]
latitude = "45.75 deg"
[plan]
dwell  = "30 min"
sample = "100 s"
mode   = "free"
[[plan.position]]
axes = "x=N y=W z=U"
[[plan.position]]
axes = "x=U y=S z=E"
sample = "300 s"
[[plan.position]]
axes = "x=S y=D z=E"
sample = "60 s"
[readout]
accelerometer_noise = "5 ug"
gimbal_noise        = "5 arcsec"
[truth]
coupling = "eq5"
terms = ["fixed_drift", "g_drift"]
[[filter]]
name     = "f"
coupling = "eq5"
terms = ["fixed_drift", "g_drift"]
[monte_carlo]
seed = 3
)";

nlohmann::json identified(const ScratchFolder& folder, const std::string& arguments) {
  const std::string out = folder.file("out");
  const Answer a = driftscope("identify " + arguments + " --quiet -o " + out);
  EXPECT_EQ(a.code, 0) << a.err;
  return nlohmann::json::parse(text_of(out + "/identification.json"));
}

TEST(OwnSamples, AFileOfTheProgramsOwnSaysWhatTheSimulationDid) {
  const ScratchFolder folder;
  const std::string toml = folder.write("study.toml", study), csv = folder.file("log.csv");
  ASSERT_EQ(driftscope("simulate " + toml + " -o " + csv).code, 0);
  const auto simulated = identified(folder, toml), read = identified(folder, toml + " " + csv);
  const auto &a = simulated["filters"][0]["starts"][0]["batch"],
             &b = read["filters"][0]["starts"][0]["batch"];
  // The same rows, noise and intervals but for the digits of the file.
  EXPECT_NEAR(a["chi2_per_dof"].get<double>(), b["chi2_per_dof"].get<double>(), 1e-4);
  ASSERT_EQ(a["parameters"].size(), 12u);
  for (const auto& [key, of_a] : a["parameters"].items()) {
    const auto& of_b = b["parameters"][key];
    const double sigma = of_a["sigma"];
    EXPECT_NEAR(of_b["sigma"].get<double>() / sigma, 1.0, 1e-4) << key;
    EXPECT_NEAR(of_a["estimate"].get<double>(), of_b["estimate"].get<double>(), 1e-2 * sigma)
        << key;
  }
}

TEST(OwnSamples, NewWritesThem) {
  const ScratchFolder folder;
  const std::string toml = folder.write("study.toml", study), csv = folder.file("log.csv"),
                    made = folder.file("new.toml");
  ASSERT_EQ(driftscope("simulate " + toml + " -o " + csv).code, 0);
  const Answer a = driftscope("new diagnose " + csv + " -o " + made);
  ASSERT_EQ(a.code, 0) << a.err;
  const std::string text = text_of(made);
  std::size_t dwells = 0;
  for (std::size_t at = 0; (at = text.find("dwell = \"1800 s\"", at)) != std::string::npos; ++at)
    ++dwells;
  EXPECT_EQ(dwells, 3u) << text;
  EXPECT_TRUE(has(text, "sample = \"300 s\"")) << text;
  EXPECT_TRUE(has(text, "sample = \"60 s\"") || has(text, "sample = \"100 s\"")) << text;
  EXPECT_EQ(driftscope("identify " + made + " " + csv + " --quiet").code, 0);
}

}  // namespace
}  // namespace drift::own_samples_test
