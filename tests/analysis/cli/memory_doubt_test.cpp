// Friction of the gimbals follows the nominal path of the platform: said where drift leads it
// along another.
#include <nlohmann/json.hpp>

#include "analysis/identification/identify.hpp"
#include "analysis/inference/thresholds.hpp"
#include "tests/support/six_positions.hpp"
#include "tests/support/synthetic.hpp"

namespace drift::memory_doubt_test {
namespace {

using namespace drift::test;

/// Twelve positions of twelve minutes, held level: the gimbals stand still in their dwells. A drift
/// of 0.5 deg/h turns them by the 40 arcsec over which friction builds up in 80 s.
std::string study(std::string_view drift) {
  return fmt::format(R"(schema = 1
[site]
latitude = "45.75 deg"
gravity = "9.806 m/s^2"
[plan]
preset = "slew12"
dwell = "12 min"
mode = "level"
[truth]
coupling = "eq6"
terms = ["fixed_drift", "stiction"]
initial_attitude = "20 arcsec"
[truth.parameters]
D_F = "{}"
F = "5 arcsec"
[[filter]]
name = "f"
coupling = "eq6"
terms = ["fixed_drift", "stiction"]
starts = 1
[monte_carlo]
runs = 1
seed = 3
)",
                     drift);
}

constexpr const char *drifting = "0.5 deg/h", *still = "0 deg/h",
                     *said = "emory of stiction (1";  // 1.. %

TEST(MemoryDoubt, IsOfTheTruthAndOfWhatIsFitted) {
  for (const char* drift : {drifting, still}) {
    const mc::Study s = mc::read_study_text(study(drift), "s.toml");
    const auto id = identification::identify_recordings(s, {simulated(s)}, 1);
    for (const auto& doubt : {identification::memory_doubt(s, 0), id.runs.front().memory_doubt}) {
      ASSERT_EQ(doubt.size(), drift == drifting ? 1u : 0u) << drift;
      if (doubt.empty()) continue;
      EXPECT_EQ(doubt.front().term, "stiction");
      EXPECT_GT(doubt.front().part, 1.0);  // friction of the wrong sign somewhere
      EXPECT_LT(doubt.front().part, 2.0);
    }
  }
}

TEST(MemoryDoubt, BeginsAtATenthOfAMemory) {
  // What is left out grows with the drift, and the bound is crossed once.
  EXPECT_EQ(inference::RemarkLimits::memory, 0.1);
  for (const auto& [drift, many] : {std::pair{"0.002 deg/h", 0u}, {"0.02 deg/h", 1u}})
    EXPECT_EQ(identification::memory_doubt(mc::read_study_text(study(drift), "s.toml"), 0).size(),
              many)
        << drift;
}

TEST(MemoryDoubt, IsToldByEveryCommandThatSimulatesOrEstimates) {
  for (const char* drift : {drifting, still}) {
    const ScratchFolder folder;
    const std::string s = folder.write("s.toml", study(drift)), recording = folder.file("r.csv");
    const auto tells = [&](const std::string& command) {
      const Answer answer = driftscope(command);
      EXPECT_EQ(answer.code, 0) << command << answer.err;
      std::string text = answer.out + answer.err;
      std::ranges::replace(text, '\n', ' ');  // however it is wrapped
      text.erase(std::unique(text.begin(), text.end(),
                             [](char a, char b) { return a == ' ' && b == ' '; }),
                 text.end());
      return text.find(said) != std::string::npos;
    };
    for (const std::string& command :
         {"check " + s, "rank " + s, "simulate " + s + " -o " + recording,
          "run " + s + " --progress none -o " + folder.file("run"),
          "identify " + s + " " + recording + " --progress none -o " + folder.file("id"),
          "diagnose " + s + " " + recording + " --progress none -o " + folder.file("d")})
      EXPECT_EQ(tells(command), drift == drifting) << command << " " << drift;
    const auto json = [&](const std::string& file) {
      return nlohmann::json::parse(text_of(folder.file(file)));
    };
    const auto filter = json("id/identification.json")["filters"][0];
    EXPECT_EQ(filter["memory_off"].contains("stiction"), drift == drifting) << filter["memory_off"];
    EXPECT_EQ(json("d/diagnosis.json")["remarks"].dump().find(said) != std::string::npos,
              drift == drifting);
    EXPECT_EQ(text_of(folder.file("d/report.html")).find(said) != std::string::npos,
              drift == drifting);
  }
}

}  // namespace
}  // namespace drift::memory_doubt_test
