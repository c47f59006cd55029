#include "analysis/strapdown/case_identify.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/strapdown/case_diagnose.hpp"
#include "core/config/load.hpp"
#include "tests/support/recordings_by_others.hpp"
#include "tests/support/strapdown_recording.hpp"

namespace drift::strapdown::case_identify_test {
namespace {

mc::Study study_with(const std::string& terms) {
  const std::string text =
      "schema = 1\n[site]\nlatitude = \"34 deg\"\ngravity = \"9.79648 m/s^2\"\n"
      "[plan]\nkind = \"strapdown\"\n[[filter]]\nname = \"nominal\"\ncoupling = \"eq5\"\nterms = "
      "[" +
      terms + "]\n";
  return mc::read_study_tree(config::parse_document(text, "study.toml"), "study.toml");
}

const std::string sensors_of_unit =
    R"("fixed_drift", "gyro_misalignment", "torquer_scale", "accelerometer")";

test::StrapdownScript script(const mc::Study& study, std::size_t dwells, double rest) {
  test::StrapdownScript s;
  s.dwells = dwells;
  s.rest = rest;
  s.turn = 8.0;
  s.gyro_noise = 3e-6;
  s.acc_noise = 1e-4;
  s.omega_ie_l = study.site.omega_ie_l();
  return s;
}

const StrapdownParameter* find(const CaseFit& fit, std::string_view key) {
  const auto at = std::ranges::find(fit.parameters, key, &StrapdownParameter::key);
  return at == fit.parameters.end() ? nullptr : &*at;
}

void expect_near(const CaseFit& fit, std::string_view key, double truth, double most) {
  const StrapdownParameter* p = find(fit, key);
  ASSERT_NE(p, nullptr) << key;
  EXPECT_LT(std::abs(p->value - truth), most) << key << " = " << p->value << " +- " << p->sigma;
}

}  // namespace

/// A foreign simulator's unit with known truth (recordings/README.md).
TEST(CaseIdentify, FindsWhatPsinsMade) {
  NEEDS_RECORDING("psins19.csv");
  const mc::Study study = study_with(sensors_of_unit);
  const Recording recording =
      read_recording(test::path_of("psins19.csv"), RecordingKind::strapdown, study.site.gravity);
  const CaseStudy of = case_study(study, recording);
  ASSERT_TRUE(of.compass.sees_earth);
  const CaseFit fit = identify_case(study, of).fits.front();
  for (const auto& [key, truth] : std::initializer_list<std::pair<const char*, double>>{
           {"D_F_x", -0.1}, {"D_F_y", -0.2}, {"D_F_z", -0.3}})
    expect_near(fit, key, truth, 0.005);
  // Three to four of their sigmas of 0.2 to 0.9: no more is to be expected of 21 at once.
  for (const auto& [key, truth] :
       std::initializer_list<std::pair<const char*, double>>{{"xi_x", 10},
                                                             {"eta_x", 20},
                                                             {"eta_y", 30},
                                                             {"xi_y", 40},
                                                             {"xi_z", 50},
                                                             {"eta_z", 60},
                                                             {"s_x", -10},
                                                             {"s_y", -20},
                                                             {"s_z", -30},
                                                             {"K0_x", -10},
                                                             {"K0_y", -20},
                                                             {"K0_z", -30},
                                                             {"K2_x", -10},
                                                             {"K2_y", -20},
                                                             {"K2_z", -30},
                                                             {"dO_y", 10},
                                                             {"dP_z", 20},
                                                             {"dO_z", 30}})
    expect_near(fit, key, truth, 4.0 * find(fit, key)->sigma);
  // The Earth left out would be 0.038 deg after a turn.
  EXPECT_LT(fit.up.held_out, 0.0038);
  const diagnosis::Diagnosis d = diagnose_case(study, identify_case(study, of));
  EXPECT_EQ(d.verdict, diagnosis::Verdict::consistent);
  EXPECT_GT(d.probabilities.consistent, 0.5);
}

TEST(CaseIdentify, ARestSaysSumsAndNoMore) {
  const mc::Study study = study_with(
      R"("fixed_drift", "g_drift", "gyro_misalignment", "torquer_scale", "accelerometer")");
  Theta theta = Theta::Zero();
  test::set(theta, "D_F_z", 0.1);
  const Recording recording = strapdown_recording(script(study, 1, 900.0), theta);
  const CaseStudy of = case_study(study, recording);
  ASSERT_TRUE(of.compass.sees_earth);
  const CaseFit fit = identify_case(study, of).fits.front();
  // No parameter alone: all that is said are sums.
  for (const StrapdownParameter& p : fit.parameters)
    EXPECT_NE(p.key.find(' '), std::string::npos) << p.key;
  // The drift about the vertical, with what of it hangs on gravity.
  const auto vertical = std::ranges::find_if(fit.parameters, [](const StrapdownParameter& p) {
    return p.key.find("D_F_z") != std::string::npos && p.key.find("D_I_z") != std::string::npos &&
           p.key.find("_x") == std::string::npos;
  });
  ASSERT_NE(vertical, fit.parameters.end());
  EXPECT_NEAR(vertical->value, 0.1, 4.0 * vertical->sigma);
  EXPECT_LT(vertical->sigma, 0.05);
  const diagnosis::Diagnosis d = diagnose_case(study, identify_case(study, of));
  EXPECT_EQ(d.verdict, diagnosis::Verdict::consistent);
}

/// What the nominal model leaves out is found as on a platform, and in the sensors' convention.
TEST(CaseDiagnose, NamesScaleAndDriftThatAreLeftOut) {
  const mc::Study study = study_with(R"("fixed_drift", "gyro_misalignment", "accelerometer")");
  Theta theta = Theta::Zero();
  test::set(theta, "D_F_x", 0.2);
  test::set(theta, "s_y", 300.0);
  for (const char* key : {"eta_x", "eta_y", "xi_y", "xi_z"}) test::set(theta, key, 60.0);
  const Recording recording = strapdown_recording(script(study, 12, 20.0), theta);
  const diagnosis::Diagnosis d =
      diagnose_case(study, identify_case(study, case_study(study, recording)));
  ASSERT_EQ(d.verdict, diagnosis::Verdict::named);
  ASSERT_EQ(d.causes.size(), 1u);
  EXPECT_EQ(d.causes[0].term, "torquer_scale");
  const auto s_y = std::ranges::find(d.causes[0].parameters, "s_y", &search::CauseParameter::key);
  ASSERT_NE(s_y, d.causes[0].parameters.end());
  EXPECT_NEAR(s_y->value, 300.0, 4.0 * s_y->sigma);
  EXPECT_TRUE(d.patched.active[TermLibrary::index("s_y")]);
  EXPECT_EQ(d.patched.coupling, Coupling::eq5);
  for (const std::string& name : d.where.channel_names)
    EXPECT_EQ(name.find("gimbal"), std::string::npos);
}

}  // namespace drift::strapdown::case_identify_test
