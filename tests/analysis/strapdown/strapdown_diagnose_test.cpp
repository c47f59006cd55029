// What a recording on a case lacks in a model of bias and scale. The real recordings of
// ../shared/recordings, where that folder is there; expected are the numbers of the README beside
// them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "analysis/diagnosis/advice/patched_study.hpp"
#include "analysis/report/diagnosis/remark_words.hpp"
#include "analysis/report/diagnosis/report.hpp"
#include "analysis/report/diagnosis/sentence.hpp"
#include "analysis/strapdown/diagnose.hpp"
#include "core/base/check.hpp"
#include "tests/analysis/report/xml_check.hpp"
#include "tests/support/program.hpp"
#include "tests/support/recordings_by_others.hpp"
#include "tests/support/strapdown_recording.hpp"

namespace drift::strapdown_diagnose_test {
namespace {

using diagnosis::Diagnosis;
using search::Cause;

constexpr double share = 0.15;  // by which dwell bounds, folds and seeds may move a number

mc::Study nominal() {
  return mc::read_study(std::string(DRIFT_SOURCE_DIR) + "/configs/diagnose_xsens.toml");
}

Recording recorded(const std::string& name) {
  return read_recording(test::path_of(name), RecordingKind::strapdown, 9.80665);
}

/// Where the verdict is asked for and no number: one division into parts is enough.
strapdown::StrapdownOptions quick() {
  strapdown::StrapdownOptions options;
  options.repeats = 1;
  return options;
}

const Cause* cause(const Diagnosis& d, std::string_view term) {
  const auto at = std::ranges::find(d.causes, term, &Cause::term);
  return at == d.causes.end() ? nullptr : &*at;
}

std::vector<std::string> groups_of(const Cause& c) {
  std::vector<std::string> groups;
  for (const auto& p : c.parameters) {
    const std::string group = p.key.substr(0, p.key.size() - 2);
    if (std::ranges::find(groups, group) == groups.end()) groups.push_back(group);
  }
  return groups;
}

bool says(const Diagnosis& d, std::string_view text) {
  return std::ranges::any_of(d.remarks, [&](const auto& r) {
    return report::in_words(r).find(text) != std::string::npos;
  });
}

// One test for one diagnosis: every test is a process of its own.
TEST(StrapdownDiagnosis,
     XsensLacksMisalignmentAndCrossAxisSensitivityAndClaimsNothingThatItCannotShow) {
  NEEDS_RECORDING("xsens_mti.csv");
  const Recording recording = recorded("xsens_mti.csv");
  const auto found = strapdown::diagnose_strapdown(nominal(), recording, {});
  const Diagnosis& d = found.diagnosis;
  EXPECT_EQ(d.verdict, diagnosis::Verdict::named);
  EXPECT_EQ(d.causes.size(), 3u);
  ASSERT_TRUE(cause(d, "gyro_misalignment") && cause(d, "g_drift") && cause(d, "accelerometer"));
  EXPECT_EQ(groups_of(*cause(d, "gyro_misalignment")), (std::vector<std::string>{"eta", "xi"}));
  EXPECT_EQ(groups_of(*cause(d, "g_drift")), (std::vector<std::string>{"D_O", "D_S"}));
  EXPECT_EQ(groups_of(*cause(d, "accelerometer")), (std::vector<std::string>{"dO", "dP"}));
  for (const Cause& c : d.causes) {
    EXPECT_LT(c.p_value, 1e-3) << c.term;
    EXPECT_GT(c.probability, 0.99) << c.term;
  }
  ASSERT_EQ(found.diagnosis.errors.size(), 3u);
  EXPECT_NEAR(found.diagnosis.errors[0].before, 0.0724, share * 0.0724);  // deg/s in dwells
  EXPECT_NEAR(found.diagnosis.errors[0].after, 0.0173, share * 0.0173);
  EXPECT_NEAR(found.diagnosis.errors[1].before, 3.46, share * 3.46);  // deg after a turn
  EXPECT_NEAR(found.diagnosis.errors[1].after, 0.142, share * 0.142);
  EXPECT_NEAR(found.diagnosis.errors[2].before, 0.0382, share * 0.0382);  // m/s^2
  EXPECT_NEAR(found.diagnosis.errors[2].after, 0.0016, share * 0.0016);
  EXPECT_TRUE(d.fit.held_out.improves);
  EXPECT_EQ(d.fit.held_out.folds.size(), 38u);

  for (const char* term : {"g2_drift", "temperature_drift", "accelerometer_temperature",
                           "frame_closure", "drift_ramp"})
    EXPECT_EQ(cause(d, term), nullptr) << term;
  for (const char* text : {"accelerometer quadratic rejected", "g2_drift rejected",
                           "g_drift, input axis alone rejected", "isotropic g-sensitivity",
                           "Earth rate", "temperature", "azimuth"})
    EXPECT_TRUE(says(d, text)) << text;
  for (const char* group : {"D_II", "D_OO", "D_SS", "D_IO", "D_IS", "D_OS", "K2", "K3", "lambda"})
    for (const Cause& c : d.causes)
      for (const auto& p : c.parameters) EXPECT_FALSE(p.key.starts_with(group)) << p.key;

  // A nominal model that holds all this is consistent with the recording.
  mc::Study patched = nominal();
  patched.filters.front() = d.patched;
  const Diagnosis again = strapdown::diagnose_strapdown(patched, recording, quick()).diagnosis;
  EXPECT_EQ(again.verdict, diagnosis::Verdict::consistent) << report::sentence(again);
  EXPECT_FALSE(again.has_patch);
  EXPECT_GT(again.p_value, 0.05);
}

TEST(StrapdownDiagnosis, MpuHasMisalignmentAndNoGSensitivity) {
  NEEDS_RECORDING("mpu9150_1.csv");
  const Diagnosis d =
      strapdown::diagnose_strapdown(nominal(), recorded("mpu9150_1.csv"), {}).diagnosis;
  EXPECT_EQ(d.verdict, diagnosis::Verdict::named);
  EXPECT_NE(cause(d, "gyro_misalignment"), nullptr);
  EXPECT_EQ(cause(d, "g_drift"), nullptr);
  EXPECT_EQ(cause(d, "g2_drift"), nullptr);
}

/// A case with fixed drift and scale, and misalignment of some size [arcsec].
Recording made(double size, std::uint64_t seed) {
  Theta theta = Theta::Zero();
  for (const char* key : {"D_F_x", "D_F_y", "D_F_z"}) test::set(theta, key, 900.0);
  test::set(theta, "s_x", 4000.0);
  test::set(theta, "eta_x", size);
  test::set(theta, "xi_y", -size);
  test::set(theta, "eta_z", 0.7 * size);
  return test::strapdown_recording({.dwells = 20, .rest = 4.0, .seed = seed}, theta);
}

TEST(StrapdownDiagnosis, RecoversTheMisalignmentThatTheRecordingWasMadeWithAndWritesItDown) {
  const strapdown::StrapdownDiagnosis found =
      strapdown::diagnose_strapdown(nominal(), made(3000.0, 5), quick());
  const Cause* c = cause(found.diagnosis, "gyro_misalignment");
  ASSERT_NE(c, nullptr) << report::sentence(found.diagnosis);
  EXPECT_EQ(found.diagnosis.causes.size(), 1u) << report::sentence(found.diagnosis);
  for (const auto& p : c->parameters) {
    const double truth = p.key == "eta_x"   ? 3000.0
                         : p.key == "xi_y"  ? -3000.0
                         : p.key == "eta_z" ? 2100.0
                                            : 0.0;
    EXPECT_NEAR(p.value, truth, 4.0 * p.sigma) << p.key;
  }
  EXPECT_TRUE(found.diagnosis.candidates.front().adequate);
  double total = 0.0;
  for (const auto& s : found.diagnosis.where.channels) total += s.share;
  EXPECT_NEAR(total, 1.0, 1e-12);

  const test::ScratchFolder folder;
  report::write_results(nominal(), found.diagnosis, {{"made"}, ""}, folder.file("out"));
  const mc::Study again = mc::read_study(folder.file("out") + "/patched.toml");
  EXPECT_EQ(again.filters.front().active, found.diagnosis.patched.active);
  EXPECT_TRUE(again.filters.front().active[TermLibrary::find("eta_x").value()]);
  EXPECT_EQ(again.kind, RecordingKind::strapdown);
  const auto json = nlohmann::json::parse(report::to_json(found.diagnosis));
  EXPECT_EQ(json["causes"][0]["term"], "gyro_misalignment");
  EXPECT_TRUE(json["fit"]["start_spread_before"].is_null());
  for (const char* key : {"chi2_per_dof_95", "log_likelihood_ratio", "predicted_by_score"})
    EXPECT_TRUE(json["fit"]["in_sample"].at(key).is_null()) << key;
  EXPECT_TRUE(json["fit"]["in_sample"]["chi2_per_dof_before"].is_number());
  EXPECT_TRUE(json["where"].at("p_value").is_null());
  EXPECT_EQ(testing::xml_problem(test::text_of(folder.file("out") + "/report.html"), {"meta"}),
            std::nullopt);
}

TEST(StrapdownDiagnosis, NothingMissingIsConsistentAndANominalEq6IsFoundOut) {
  EXPECT_EQ(strapdown::diagnose_strapdown(nominal(), made(0.0, 6), quick()).diagnosis.verdict,
            diagnosis::Verdict::consistent);
  mc::Study six = nominal();
  six.filters.front().coupling = Coupling::eq6;
  const Diagnosis d = strapdown::diagnose_strapdown(six, made(3000.0, 5), quick()).diagnosis;
  ASSERT_NE(cause(d, "frame_closure"), nullptr);
  EXPECT_NE(cause(d, "gyro_misalignment"), nullptr);
  EXPECT_EQ(d.patched.coupling, Coupling::eq5);
}

TEST(StrapdownDiagnosis, WithoutAFilterThereIsNoNominalModel) {
  mc::Study study = nominal();
  study.filters.clear();
  EXPECT_THROW(strapdown::diagnose_strapdown(study, made(0.0, 1), {}), InputError);
}

TEST(ChanceOfGain, IsTheTailOfStudentsT) {
  using strapdown::chance_of_gain;
  // dof 1: 1/2 - atan(t)/pi; dof 2: 1/2 - t / (2 sqrt(2 + t^2)); dof 40: 2.5 % at 2.0211 (tables).
  for (const double t : {-3.0, -0.5, 0.3, 1.0, 12.0}) {
    EXPECT_NEAR(chance_of_gain(t, 2), 0.5 - std::atan(t) / std::numbers::pi, 1e-12);
    EXPECT_NEAR(chance_of_gain(t, 3), 0.5 - t / (2.0 * std::sqrt(2.0 + t * t)), 1e-12);
  }
  EXPECT_NEAR(chance_of_gain(2.0211, 41), 0.025, 1e-5);
  EXPECT_NEAR(chance_of_gain(0.0, 10), 0.5, 1e-12);
  EXPECT_GT(chance_of_gain(40.0, 38), 0.0);
  EXPECT_EQ(chance_of_gain(3.0, 1), 1.0);
  EXPECT_EQ(chance_of_gain(std::nan(""), 10), 1.0);
}

}  // namespace
}  // namespace drift::strapdown_diagnose_test
