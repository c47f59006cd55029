#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numbers>

#include "tests/core/config/typos.hpp"
#include "tests/mc/small_study.hpp"
#include "tests/mc/study/study_file.hpp"

namespace drift::study_config_test {
namespace {

constexpr double arcsec = std::numbers::pi / 180.0 / 3600.0;
constexpr double deg_per_h = arcsec;  // per second

mc::Resolved resolved(const mc::Study& study, const std::string& key) {
  for (const auto& value : study.resolved)
    if (value.key == key) return value;
  ADD_FAILURE() << key << " is not in the resolved list";
  return {};
}

TEST(StudyConfig, EveryFeatureOfTheFileReachesTheStudy) {
  const mc::Study s = test::read_text(test::full_study);
  EXPECT_EQ(s.title, "Everything at once");
  EXPECT_NEAR(s.site.latitude, 45.75 * std::numbers::pi / 180.0, 1e-15);
  EXPECT_DOUBLE_EQ(s.site.gravity, 9.806);
  EXPECT_EQ(s.kind, RecordingKind::platform);
  EXPECT_NEAR(s.plan.slew_rate, 900.0 * arcsec, 1e-15);
  ASSERT_EQ(s.plan.positions.size(), 2u);
  EXPECT_EQ(s.plan.positions[0].name, "z up, x north");
  EXPECT_EQ(s.plan.positions[1].name, "position 2");
  EXPECT_DOUBLE_EQ(s.plan.positions[0].dwell, 1800.0);
  EXPECT_DOUBLE_EQ(s.plan.positions[1].dwell, 3600.0);
  EXPECT_EQ(s.plan.positions[0].mode, CommandLaw::free);
  EXPECT_EQ(s.plan.positions[1].mode, CommandLaw::level);
  EXPECT_EQ(s.plan.positions[0].entry, Entry::caged);
  EXPECT_EQ(s.plan.positions[1].entry, Entry::torqued);
  EXPECT_NEAR(s.plan.positions[0].case_heading.value(), std::numbers::pi / 2.0, 1e-15);
  EXPECT_FALSE(s.plan.positions[1].case_heading);
  EXPECT_DOUBLE_EQ(s.readout.accelerometer_noise, 50e-6);
  EXPECT_NEAR(s.readout.gimbal_noise, 30.0 * arcsec, 1e-18);

  EXPECT_TRUE(s.has_truth);
  EXPECT_EQ(s.truth.coupling, Coupling::compensated);
  EXPECT_EQ(s.truth.active.count(), 3u + 3u + 1u + 6u + 3u);
  const auto prior = [&](const char* key) {
    return s.truth.priors[TermLibrary::find(key).value()];
  };
  EXPECT_NEAR(prior("eta_x").a, 112.0 * arcsec, 1e-15);
  EXPECT_NEAR(prior("eta_x").b, 20.0 * arcsec, 1e-15);
  EXPECT_EQ(prior("eta_y").kind, Prior::Kind::uniform);
  EXPECT_NEAR(prior("eta_y").a, -60.0 * arcsec, 1e-15);
  EXPECT_EQ(prior("D_I_x").kind, Prior::Kind::fixed);
  EXPECT_NEAR(prior("D_I_x").a, 1.45 * deg_per_h, 1e-15);
  EXPECT_DOUBLE_EQ(prior("s_x").a, 5e-4);
  EXPECT_DOUBLE_EQ(prior("s_y").a, 1e-4);
  EXPECT_EQ(prior("D_F_x"), TermLibrary::specs[TermLibrary::index("D_F_x")].prior_si());
  EXPECT_NEAR(s.truth.noise.angle_random_walk, 0.001 * 3600.0 * arcsec / 60.0, 1e-18);
  EXPECT_NEAR(s.truth.theta_loop[TermLibrary::index("eta_x")], 100.0 * arcsec, 1e-15);
  EXPECT_NEAR(s.truth.theta_loop[TermLibrary::index("xi_y")], 5.0 * arcsec, 1e-15);
  EXPECT_NEAR(s.truth.theta_loop[TermLibrary::index("xi_z")], 6.0 * arcsec, 1e-15);
  EXPECT_EQ(s.truth.mounting.gyro.second[0].index, 2);
  EXPECT_EQ(s.truth.mounting.gyro.second[0].sign, -1.0);

  ASSERT_EQ(s.filters.size(), 2u);
  EXPECT_EQ(s.filters[0].name, "corrected");
  EXPECT_EQ(s.filters[1].name, "filter 2");
  ASSERT_EQ(s.filters[0].starts.size(), 2u);
  EXPECT_EQ(s.filters[0].starts[0].size(), 4u);
  EXPECT_TRUE(s.filters[0].starts[1].empty());
  EXPECT_EQ(s.filters[0].priors[TermLibrary::index("K3_y")], fixed(0.0));
  EXPECT_EQ(s.filters[0].mounting.gyro.second[0].sign, -1.0);
  EXPECT_TRUE(s.filters[1].active[TermLibrary::index("lambda")]);
  EXPECT_EQ(s.filters[1].drawn_starts, 3);
  EXPECT_EQ(s.monte_carlo.runs, 2000u);
  EXPECT_EQ(s.monte_carlo.seed, 0xFFFFFFFFFFFFFFFFu);
  EXPECT_EQ(s.monte_carlo.allowed_failures, 3u);
  ASSERT_EQ(s.sweep.size(), 2u);
  EXPECT_EQ(s.sweep[0].key, "truth.parameters.eta_x");
  EXPECT_EQ(s.sweep[0].values, (std::vector<std::string>{"\"20 arcsec\"", "\"100 arcsec\""}));
}

TEST(StudyConfig, TheResolvedListNamesTheOriginOfEveryValue) {
  const mc::Study s = test::read_text(test::full_study, {{"plan.position.1.dwell", "10 min"}});
  EXPECT_EQ(resolved(s, "site.latitude").value, "45.75 deg");
  EXPECT_EQ(resolved(s, "site.latitude").origin, "study.toml:5");
  EXPECT_EQ(resolved(s, "truth.parameters.eta_x").value, "normal(112, 20) arcsec");
  EXPECT_EQ(resolved(s, "truth.parameters.D_F_x").value, "normal(0, 1) deg/h");
  EXPECT_EQ(resolved(s, "truth.parameters.D_F_x").origin, "default prior");
  EXPECT_EQ(resolved(s, "plan.position.1.dwell").value, "10 min");
  EXPECT_EQ(resolved(s, "plan.position.1.dwell").origin, "--set");
  EXPECT_EQ(resolved(s, "filter.corrected.drift_random_walk").origin, "default");
  EXPECT_EQ(resolved(s, "filter.1.terms").value, "gyro_misalignment, frame_closure");
}

TEST(StudyConfig, AListThatWasAddedToComesFromBothPlaces) {
  const mc::Study file = test::read_text(test::full_study);
  const std::string line = resolved(file, "filter.1.terms").origin;
  EXPECT_TRUE(line.starts_with("study.toml:")) << line;
  const mc::Study added = test::read_text(test::full_study, {{"filter.1.terms+", "drift_ramp.y"}});
  EXPECT_EQ(resolved(added, "filter.1.terms").value,
            "gyro_misalignment, frame_closure, drift_ramp.y");
  EXPECT_EQ(resolved(added, "filter.1.terms").origin, line + " and --set");
  const mc::Study replaced = test::read_text(
      test::full_study,
      {{"filter.1.terms", "[\"gyro_misalignment\"]"}, {"filter.1.terms+", "drift_ramp.y"}});
  EXPECT_EQ(resolved(replaced, "filter.1.terms").origin, "--set");
}

TEST(StudyConfig, AStudyOfRecordingsNeedsNeitherTruthNorFilter) {
  const mc::Study s =
      test::read_text("schema = 1\nsite.latitude = \"45 deg\"\nplan.preset = \"six\"\n");
  EXPECT_FALSE(s.has_truth);
  EXPECT_TRUE(s.filters.empty());
  EXPECT_EQ(s.plan.positions.size(), 6u);
  EXPECT_EQ(s.monte_carlo.runs, 100u);
}

TEST(StudyConfig, AStrapdownStudyNeedsNoLatitude) {
  const mc::Study s =
      test::read_text("schema = 1\n[plan]\nkind = \"strapdown\"\nstatic_min = \"3 s\"\n");
  EXPECT_EQ(s.kind, RecordingKind::strapdown);
  EXPECT_DOUBLE_EQ(s.static_min, 3.0);
  EXPECT_FALSE(s.accelerometers_in_turns);
}

TEST(StudyConfig, OverridesActBeforeReading) {
  const mc::Overrides overrides = {{"truth.parameters.eta_x", "20 arcsec"},
                                   {"plan.dwell", "10 min"},
                                   {"filter.corrected.coupling", "eq6"},
                                   {"filter.1.parameters.lambda", "{ normal = [0.5, 0.1] }"},
                                   {"monte_carlo.seed", "0x10"}};
  const mc::Study s = test::read_text(test::full_study, overrides);
  EXPECT_EQ(s.truth.priors[TermLibrary::index("eta_x")], fixed(20.0 * unit::arcsec.to_si));
  EXPECT_DOUBLE_EQ(s.plan.positions[1].dwell, 600.0);
  EXPECT_EQ(s.filters[0].coupling, Coupling::eq6);
  EXPECT_EQ(s.filters[1].priors[TermLibrary::index("lambda")], normal(0.5, 0.1));
  EXPECT_EQ(s.monte_carlo.seed, 16u);
}

TEST(StudyConfig, MistakesOfOverridesNameTheOption) {
  const auto found =
      test::mistakes(test::full_study, {{"plan.dwel", "10 min"}, {"truth.coupling", "eq7"}});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_TRUE(found[0].starts_with("--set plan.dwel: unknown key 'plan.dwel'")) << found[0];
  EXPECT_NE(found[0].find("Did you mean 'dwell'?"), std::string::npos);
  EXPECT_TRUE(found[1].starts_with("--set truth.coupling: 'truth.coupling' is the string \"eq7\""))
      << found[1];
}

TEST(StudyConfig, ASweptCouplingMayKeepTheTablesOfTheOthers) {
  const std::string text =
      "schema = 1\nsite.latitude = \"45 deg\"\nplan.preset = \"six\"\n[truth]\ncoupling = \"eq5\"\n"
      "[truth.servo]\nloop_gain = \"100 N*m/rad\"\n";
  EXPECT_EQ(test::mistakes(text).size(), 1u);
  EXPECT_TRUE(
      test::mistakes(text + "[sweep]\n\"truth.coupling\" = [\"eq5\", \"servo\"]\n").empty());
  const mc::Study s = test::read_text(text, {{"truth.coupling", "servo"}});
  EXPECT_DOUBLE_EQ(s.truth.servo.loop_gain, 100.0);
}

TEST(StudyConfig, TheTextOfAStudyReadsBackToTheSameStudy) {
  const test::StudyFile file(test::full_study);
  const mc::Overrides overrides = {{"filter.corrected.terms", "[\"g_drift\", \"accelerometer\"]"},
                                   {"filter.corrected.starts", "2"}};
  const std::string text = mc::read_study(file.path(), overrides).text;
  const mc::Study direct = mc::read_study(file.path(), overrides), written = test::read_text(text);
  ASSERT_EQ(direct.resolved.size(), written.resolved.size());
  for (std::size_t i = 0; i < direct.resolved.size(); ++i) {
    EXPECT_EQ(direct.resolved[i].key, written.resolved[i].key);
    EXPECT_EQ(direct.resolved[i].value, written.resolved[i].value);
  }
  EXPECT_EQ(direct.truth.priors, written.truth.priors);
  EXPECT_EQ(direct.filters[0].active, written.filters[0].active);
  EXPECT_EQ(mc::read_study(test::StudyFile(text).path()).text, text);
}

TEST(StudyConfig, AMisspeltOverrideOfAKeyOfTheFileIsRecognised) {
  const std::string text =
      test::small_study +
      "[readout]\naccelerometer_noise = \"5 ug\"\ngimbal_noise = \"5 arcsec\"\n";
  for (const char* key : {"accelerometer_noise", "gimbal_noise"}) {
    const std::string typo = std::string(key).substr(0, std::strlen(key) - 1);
    const auto found = test::mistakes(text, {{"readout." + typo, "\"5 ug\""}});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NE(found[0].find(std::string("Did you mean '") + key + "'?"), std::string::npos)
        << found[0];
  }
}

/// Keys of full_study that stand alone on their line, with every slip in each of them.
TEST(StudyConfig, MisspeltKeysOfSectionsAreRecognised) {
  int all = 0, right = 0;
  std::string missed;
  std::size_t start = 0;
  bool in_sweep = false;
  while (start < test::full_study.size()) {
    const auto end = test::full_study.find('\n', start);
    const std::string line = test::full_study.substr(start, end - start);
    const bool header = line.starts_with('[');
    in_sweep = in_sweep || line == "[sweep]";
    const auto first = header ? line.find_last_of("[.") + 1 : 0;
    const auto last = header ? line.find(']') : line.find(" =");
    const bool usable = !line.empty() && last != std::string::npos && (header || !in_sweep);
    if (usable) {
      const std::string key = line.substr(first, last - first);
      for (const auto& typo : test::typos(key)) {
        std::string text = test::full_study;
        text.replace(start + first, key.size(), typo);
        const auto found = test::mistakes(text);
        if (found.empty()) continue;  // another valid key
        ++all;
        const bool hit = std::any_of(found.begin(), found.end(), [&](const std::string& message) {
          return message.find("Did you mean '" + key + "'") != std::string::npos;
        });
        right += hit;
        if (!hit) missed += " " + key + "->" + typo;
      }
    }
    start = end + 1;
  }
  std::printf("[ measured ] section keys: top-1 of %d slips %.1f %%; missed:%s\n", all,
              100.0 * right / all, missed.c_str());
  EXPECT_GT(all, 1500);
  EXPECT_GE(right, 0.95 * all);
}

}  // namespace
}  // namespace drift::study_config_test
