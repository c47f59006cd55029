#include "core/physics/model_config.hpp"

#include <gtest/gtest.h>

#include "core/base/check.hpp"
#include "core/config/load.hpp"
#include "core/physics/mounting_config.hpp"
#include "core/physics/parameters_config.hpp"

namespace drift::model_config_test {
namespace {

struct Read {
  std::vector<std::string> mistakes;
  TruthSpec truth;
  std::vector<FilterSpec> filters;
  Mounting mounting;
};

Read read(const std::string& text) {
  const config::Node root = config::parse_document(text, "t.toml");
  config::Report report("t.toml");
  config::Section top(report, &root, {}, "");
  Read result;
  result.mounting = read_mounting(top.section("mounting"));
  result.truth = read_truth(top.section("truth"), result.mounting, UnusedTables::refused);
  result.filters = read_filters(top, result.mounting);
  top.finish();
  try {
    report.throw_if_wrong();
  } catch (const InputError& error) {
    result.mistakes = error.messages();
  }
  return result;
}

std::vector<std::string> active(const ModelSpec& spec) {
  return terms_text(spec.active);
}
using Keys = std::vector<std::string>;

TEST(ModelConfig, EntriesOfTermsMayBeTermsAxesGroupsAndParameters) {
  EXPECT_EQ(params_named("fixed_drift").count(), 3u);
  EXPECT_EQ(params_named("g_drift").count(), 9u);
  EXPECT_EQ(params_named("g_drift.x").count(), 3u);
  EXPECT_EQ(params_named("D_I").count(), 3u);
  EXPECT_EQ(params_named("D_I_z").count(), 1u);
  EXPECT_TRUE(params_named("g_drift.x")[TermLibrary::index("D_S_x")]);
  EXPECT_TRUE(params_named("lambda")[TermLibrary::index("lambda")]);
  const ParamMask middle = params_named("encoder_harmonics.middle");
  EXPECT_TRUE(middle[TermLibrary::index("enc_s1_middle")]);
  EXPECT_FALSE(middle[TermLibrary::index("enc_s1_outer")]);
  for (const char* none : {"", ".", "g_drift.", "g_drift.w", "g_drift.xx", "D_I.x", "D_I_", ".x"})
    EXPECT_TRUE(params_named(none).none()) << none;
}

TEST(ModelConfig, TheListOfTermsRebuildsEveryMask) {
  for (const Keys& list :
       {Keys{"g_drift", "accelerometer"}, Keys{"fixed_drift.y", "D_I", "eta_x"}, Keys{},
        Keys{"gyro_misalignment.z", "K0_x", "K1_x", "s"}, Keys{"encoder_harmonics.middle"}}) {
    ParamMask mask, again;
    for (const auto& key : list) mask |= params_named(key);
    for (const auto& key : terms_text(mask)) again |= params_named(key);
    EXPECT_EQ(again, mask);
  }
}

TEST(ModelConfig, WithoutTermsTheBaseTermsHold) {
  const Read r = read("[truth]\ncoupling = \"eq6\"\n");
  EXPECT_TRUE(r.mistakes.empty());
  EXPECT_EQ(r.truth.coupling, Coupling::eq6);
  EXPECT_EQ(active(r.truth), (Keys{"fixed_drift", "g_drift", "g2_drift", "gyro_misalignment",
                                   "torquer_scale", "accelerometer"}));
  EXPECT_EQ(r.truth.priors[TermLibrary::index("K0_x")], normal(0.0, 500.0).scaled(unit::ug.to_si));
}

TEST(ModelConfig, TheLambdaFamilyBringsItsWeight) {
  const Read r = read(
      "[[filter]]\ncoupling = \"lambda\"\nterms = [\"fixed_drift\"]\nparameters.lambda = 0.25\n");
  EXPECT_TRUE(r.mistakes.empty());
  EXPECT_EQ(active(r.filters.at(0)), (Keys{"fixed_drift", "frame_closure"}));
  EXPECT_EQ(r.filters[0].priors[TermLibrary::index("lambda")], fixed(0.25));
  EXPECT_EQ(r.filters[0].name, "filter 1");
}

TEST(ModelConfig, AFilterThatEstimatesNothingIsAMistake) {
  EXPECT_EQ(read("[[filter]]\ncoupling = \"eq5\"\nterms = []\n").mistakes.size(), 1u);
  EXPECT_EQ(
      read("[[filter]]\ncoupling = \"eq5\"\nterms = [\"D_F_x\"]\nparameters.D_F_x = \"1 deg/h\"\n")
          .mistakes.size(),
      1u);
}

TEST(ModelConfig, AParameterOfAModelWithoutTermsIsSaidSo) {
  const Read r = read(
      "[truth]\ncoupling = \"eq5\"\nterms = []\nparameters.eta_x = \"5 arcsec\"\n"
      "[[filter]]\ncoupling = \"eq5\"\n");
  ASSERT_EQ(r.mistakes.size(), 1u);
  EXPECT_NE(r.mistakes[0].find("(expected none: terms is empty)"), std::string::npos)
      << r.mistakes[0];
}

TEST(ModelConfig, AGroupStandsForItsActiveAxes) {
  const Read r = read(
      "[[filter]]\ncoupling = \"eq5\"\nterms = [\"gyro_misalignment.x\", \"eta_y\"]\n"
      "parameters.eta = \"5 arcsec\"\n");
  EXPECT_TRUE(r.mistakes.empty());
  EXPECT_EQ(r.filters[0].priors[TermLibrary::index("eta_x")], fixed(5.0 * unit::arcsec.to_si));
  EXPECT_EQ(r.filters[0].priors[TermLibrary::index("eta_y")], fixed(5.0 * unit::arcsec.to_si));
  EXPECT_FALSE(r.filters[0].active[TermLibrary::index("eta_z")]);
}

TEST(ModelConfig, AParametersOwnKeyWinsOverItsGroupInAnyOrder) {
  for (const char* text : {"eta_x = \"1 arcsec\"\neta = \"2 arcsec\"\n",
                           "eta = \"2 arcsec\"\neta_x = \"1 arcsec\"\n"}) {
    const Read r = read(std::string("[truth]\ncoupling = \"eq5\"\n[truth.parameters]\n") + text);
    EXPECT_EQ(r.truth.priors[TermLibrary::index("eta_x")], fixed(1.0 * unit::arcsec.to_si));
    EXPECT_EQ(r.truth.priors[TermLibrary::index("eta_z")], fixed(2.0 * unit::arcsec.to_si));
  }
}

TEST(ModelConfig, TheServoTableFillsItsOptions) {
  const Read r = read(
      "[truth]\ncoupling = \"servo\"\n[truth.servo]\nlead = \"30 ms\"\nbase_amplitude = \"1 "
      "arcsec\"\n"
      "constant_torque = [\"1 N*m\", \"0 N*m\", \"-2 N*m\"]\n"
      "motor_coupling = [[1, 0.1, 0], [0, 1, 0], [0, 0, 1]]\n");
  EXPECT_TRUE(r.mistakes.empty());
  EXPECT_DOUBLE_EQ(r.truth.servo.lead, 0.03);
  EXPECT_EQ(r.truth.servo.constant_torque, Vec3(1.0, 0.0, -2.0));
  EXPECT_EQ(r.truth.servo.motor_coupling(0, 1), 0.1);
  EXPECT_EQ(r.truth.servo.motor_coupling(1, 0), 0.0);
  EXPECT_DOUBLE_EQ(r.truth.servo.loop_gain, ServoOptions{}.loop_gain);
}

TEST(ModelConfig, TheLoopMayUseTheRunningEstimate) {
  const Read r = read("[truth]\ncoupling = \"compensated\"\nloop.estimate = \"feedback\"\n");
  EXPECT_TRUE(r.mistakes.empty());
  EXPECT_EQ(r.truth.loop, LoopEstimate::feedback);
  EXPECT_TRUE(r.truth.theta_loop.isZero(0.0));
}

TEST(ModelConfig, AStartMayNotNameAKnownConstant) {
  const Read r = read(
      "[[filter]]\ncoupling = \"eq5\"\nstarts = [{ eta_x = \"1 arcsec\" }]\nparameters.eta_x = \"0 "
      "arcsec\"\n");
  ASSERT_EQ(r.mistakes.size(), 1u);
  EXPECT_TRUE(r.mistakes[0].starts_with("t.toml:3:13: 'filter.0.starts.0.eta_x' is not estimated"))
      << r.mistakes[0];
}

TEST(ModelConfig, MountingsAreRightHandedAndBeginWithTheirOwnAxis) {
  const Read r = read("[mounting]\ngyro_x = \"x -y -z\"\naccelerometer_y = \"+y -x z\"\n");
  EXPECT_TRUE(r.mistakes.empty());
  const Vec3 v(1.0, 2.0, 3.0);
  EXPECT_EQ(r.mounting.gyro.along_second(v), Vec3(-2.0, 3.0, 1.0));
  EXPECT_EQ(r.mounting.gyro.along_third(v), Vec3(-3.0, 1.0, 2.0));
  EXPECT_EQ(r.mounting.accelerometer.along_second(v)[1], -1.0);
  for (const char* bad :
       {"x z y", "-x y z", "y z x", "x y", "x y z x", "x x y", "x - y z", "", "x y q", "x y z-"}) {
    const auto mistakes = read(std::string("[mounting]\ngyro_x = \"") + bad + "\"\n").mistakes;
    ASSERT_EQ(mistakes.size(), 1u) << bad;
    EXPECT_TRUE(mistakes[0].starts_with("t.toml:2:10:")) << mistakes[0];
  }
}

TEST(ModelConfig, EveryCardinalRightHandedMountingIsAccepted) {
  int accepted = 0;
  for (const char* second : {"y", "-y", "z", "-z"})
    for (const char* third : {"y", "-y", "z", "-z"})
      accepted += read(std::string("[mounting]\ngyro_x = \"x ") + second + " " + third + "\"\n")
                      .mistakes.empty();
  EXPECT_EQ(accepted, 4);  // the rotations about x
}

}  // namespace
}  // namespace drift::model_config_test
