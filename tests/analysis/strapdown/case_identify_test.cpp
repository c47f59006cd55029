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

mc::Study study_with(const std::string& terms, const std::string& plan = "") {
  const std::string text =
      "schema = 1\n[site]\nlatitude = \"34 deg\"\ngravity = \"9.79648 m/s^2\"\n"
      "[plan]\nkind = \"strapdown\"\n" +
      plan +
      "[[filter]]\nname = \"nominal\"\ncoupling = \"eq5\"\nterms = "
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
  s.gravity = study.site.gravity;
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

const std::string read_in_turns = "accelerometers_in_turns = true\n";

/// Lever arms and delay are the causes, each within four sigma.
void expect_named(const diagnosis::Diagnosis& d,
                  const std::vector<std::pair<const char*, double>>& truth) {
  for (const search::Cause& c : d.causes)
    EXPECT_TRUE(c.term == "inner_lever_arm" || c.term == "accelerometer_delay") << c.term;
  for (const auto& [key, value] : truth) {
    const search::CauseParameter* found = nullptr;
    for (const search::Cause& c : d.causes)
      for (const search::CauseParameter& p : c.parameters)
        if (p.key == key) found = &p;
    ASSERT_NE(found, nullptr) << key;
    EXPECT_LT(std::abs(found->value - value), 4.0 * found->sigma)
        << key << " = " << found->value << " +- " << found->sigma;
  }
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
  // What acts while the case turns is said to be out of sight.
  for (const char* term : {"inner_lever_arm", "accelerometer_delay"}) {
    const auto left_out = std::ranges::find(d.not_examined, term, &diagnosis::NotExamined::term);
    ASSERT_NE(left_out, d.not_examined.end()) << term;
    EXPECT_EQ(left_out->why, diagnosis::NotExamined::Why::no_turns);
  }
}

/// What its simulator knew beyond that, with the accelerometers read in turns. Its signs are those
/// of its other errors: "output error with minus".
TEST(CaseDiagnose, NamesLeverArmsAndDelayOfPsins) {
  NEEDS_RECORDING("psins19.csv");
  const mc::Study study = study_with(sensors_of_unit, read_in_turns);
  const Recording recording =
      read_recording(test::path_of("psins19.csv"), RecordingKind::strapdown, study.site.gravity);
  const diagnosis::Diagnosis d =
      diagnose_case(study, identify_case(study, case_study(study, recording)));
  ASSERT_EQ(d.verdict, diagnosis::Verdict::named);
  expect_named(d, {{"arm_x_x", -1},
                   {"arm_y_x", -2},
                   {"arm_z_x", -3},
                   {"arm_x_y", -4},
                   {"arm_y_y", -5},
                   {"arm_z_y", -6},
                   {"arm_x_z", 0},
                   {"arm_y_z", 0},
                   {"arm_z_z", 0},
                   {"acc_delay", -1}});
  const auto up = std::ranges::find(d.errors, "up after a turn", &diagnosis::ErrorOfKind::what);
  ASSERT_NE(up, d.errors.end());
  EXPECT_LT(up->after, 0.0004);
  EXPECT_GT(up->before, 0.002);
  EXPECT_EQ(d.errors.back().unit, "ug");  // as `identify` has it
}

/// The same of a unit of our own, and nothing where nothing is left out.
TEST(CaseDiagnose, NamesLeverArmsAndDelayOnlyWhereTheyAre) {
  const mc::Study study = study_with(sensors_of_unit, read_in_turns);
  Theta theta = Theta::Zero();
  for (const char* key : {"eta_x", "eta_y", "xi_y", "xi_z"}) test::set(theta, key, 60.0);
  const auto diagnosed = [&](std::uint64_t seed) {
    test::StrapdownScript s = script(study, 12, 20.0);
    s.seed = seed;
    return diagnose_case(study,
                         identify_case(study, case_study(study, strapdown_recording(s, theta))));
  };
  for (const std::uint64_t seed : {31, 32})
    EXPECT_EQ(diagnosed(seed).verdict, diagnosis::Verdict::consistent) << seed;
  const std::vector<std::pair<const char*, double>> truth{
      {"arm_x_x", 3},  {"arm_y_x", -2}, {"arm_z_x", 4}, {"arm_x_y", -4}, {"arm_y_y", 5},
      {"arm_z_y", -3}, {"arm_x_z", 2},  {"arm_y_z", 6}, {"arm_z_z", -5}, {"acc_delay", 2}};
  for (const auto& [key, value] : truth) test::set(theta, key, value);
  const diagnosis::Diagnosis d = diagnosed(33);
  ASSERT_EQ(d.verdict, diagnosis::Verdict::named);
  expect_named(d, truth);
}

TEST(CaseDiagnose, ATermOfTurnsIsRefusedWhereTheyAreNotRead) {
  const mc::Study study = study_with(sensors_of_unit + R"(, "inner_lever_arm")");
  const Recording recording = strapdown_recording(script(study, 12, 20.0), Theta::Zero());
  EXPECT_THROW(identify_case(study, case_study(study, recording)), InputError);
}

/// A wrong unit is no missing physics: it is said before anything else.
TEST(CaseStudy, GyrosInAnotherUnitOrOfTheOtherSignAreRefused) {
  const mc::Study study = study_with(sensors_of_unit);
  const Recording right = strapdown_recording(script(study, 8, 10.0), Theta::Zero());
  EXPECT_NO_THROW(case_study(study, right));
  for (const auto& [times, words] : std::initializer_list<std::pair<double, const char*>>{
           {detail::deg, "look like [rad/s], not [deg/s]"},
           {1.0 / detail::deg, "look like [deg/s], not [rad/s]"},
           {-1.0, R"(gyro_x = "-gyro_x", gyro_y = "-gyro_y", gyro_z = "-gyro_z")"}}) {
    Recording wrong = right;
    for (const std::size_t channel : {1, 2, 3})
      for (double& rate : wrong.channels[channel].values) rate *= times;
    try {
      case_study(study, wrong);
      ADD_FAILURE() << words;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
    }
  }
}

/// Exchanged or reversed columns, of gyros or of accelerometers, with the line that mends them.
TEST(CaseStudy, ColumnsThatAreExchangedOrReversedAreNamed) {
  const mc::Study study = study_with(sensors_of_unit);
  const Recording right = strapdown_recording(script(study, 12, 10.0), Theta::Zero());
  struct Wrong {
    std::size_t a, b;  // columns; the same: reversed
    const char* words;
  };
  for (const Wrong& w : {Wrong{1, 1, "gyro_x = \"-gyro_x\""}, Wrong{3, 3, "gyro_z = \"-gyro_z\""},
                         Wrong{5, 5, "acc_y = \"-acc_y\""}, Wrong{1, 2, "gyro_x = \"gyro_y\""},
                         Wrong{5, 6, "acc_y = \"acc_z\""}}) {
    Recording wrong = right;
    if (w.a == w.b)
      for (double& value : wrong.channels[w.a].values) value = -value;
    else
      std::swap(wrong.channels[w.a].values, wrong.channels[w.b].values);
    try {
      case_study(study, wrong);
      ADD_FAILURE() << w.words;
    } catch (const InputError& e) {
      const std::string said = e.what();
      EXPECT_NE(said.find(w.words), std::string::npos) << said;
      EXPECT_EQ(said.find(". Or "), std::string::npos) << said;
    }
  }
}

TEST(CaseStudy, OneAccelerometerInAnotherUnitIsNamed) {
  const mc::Study study = study_with(sensors_of_unit);
  Theta theta = Theta::Zero();
  for (const char axis : {'x', 'y', 'z'}) {  // 2 mg and 0.2 %, which are estimated
    test::set(theta, std::string("K0_") + axis, 2e3);
    test::set(theta, std::string("K1_") + axis, 2e3);
  }
  const Recording right = strapdown_recording(script(study, 8, 10.0), theta);
  EXPECT_NO_THROW(case_study(study, right));
  for (int axis = 0; axis < 3; ++axis)
    for (const auto& [times, words] : std::initializer_list<std::pair<double, const char*>>{
             {9.80665, "look like [m/s^2], not [g]"}, {1e3, "look like [mg], not [g]"}}) {
      Recording wrong = right;
      Channel& odd = wrong.channels[static_cast<std::size_t>(4 + axis)];
      for (double& f : odd.values) f *= times;
      try {
        case_study(study, wrong);
        ADD_FAILURE() << odd.name << words;
      } catch (const InputError& e) {
        const std::string said = e.what();
        EXPECT_NE(said.find(words), std::string::npos) << said;
        EXPECT_NE(said.find(":" + odd.name + ": the accelerometers together read"),
                  std::string::npos)
            << said;
      }
    }
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
