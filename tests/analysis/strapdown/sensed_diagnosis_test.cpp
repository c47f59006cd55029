// What leaves a diagnosis of a case is as the sensors have it, every number of a parameter alike.
#include "analysis/strapdown/sensed_diagnosis.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/diagnosis/advice/patched_study.hpp"
#include "analysis/strapdown/consumer_grade.hpp"
#include "core/base/nan.hpp"

namespace drift::strapdown::sensed_diagnosis_test {
namespace {

using diagnosis::Diagnosis;
using diagnosis::Profile;
using search::CauseParameter;

/// A cause at 3 with a skew interval of 2 to 5, and its profile.
void add_cause(Diagnosis& d, std::string_view key, int set = 0, double value = 3.0) {
  const std::size_t param = *TermLibrary::find(key);
  const std::string unit(TermLibrary::specs[param].unit.symbol.view());
  CauseParameter p{std::string(key), param, value, 0.5, unit};
  p.prior_sigmas = 4.0;
  p.low_95 = value - 1.0;
  p.high_95 = value + 2.0;
  p.top = value - 0.1;
  search::Cause cause;
  cause.term = key;
  cause.set = set;
  cause.parameters = {p};
  d.causes.push_back(cause);
  Profile profile{.label = std::string(key),
                  .set = set,
                  .key = p.key,
                  .unit = unit,
                  .param = param,
                  .value = value,
                  .sigma = 0.5};
  profile.points = {{value - 2.0, 9.0}, {value - 0.1, 0.0}, {value + 3.0, 8.0}};
  profile.top = value - 0.1;
  profile.low_95 = p.low_95;
  profile.high_95 = p.high_95;
  d.profiles.push_back(profile);
}

void expect_one_story(const Diagnosis& d) {
  ASSERT_EQ(d.causes.size(), d.profiles.size());
  for (std::size_t k = 0; k < d.causes.size(); ++k) {
    const CauseParameter& p = d.causes[k].parameters[0];
    const Profile& profile = d.profiles[k];
    EXPECT_LT(p.low_95, p.value) << p.key;
    EXPECT_LT(p.value, p.high_95) << p.key;
    EXPECT_EQ(p.value, profile.value) << p.key;
    EXPECT_EQ(p.sigma, profile.sigma) << p.key;
    EXPECT_EQ(p.low_95, profile.low_95) << p.key;
    EXPECT_EQ(p.high_95, profile.high_95) << p.key;
    EXPECT_EQ(p.top, profile.top) << p.key;
    EXPECT_TRUE(std::ranges::is_sorted(profile.points, {}, &Profile::Point::value)) << p.key;
    EXPECT_LT(profile.points.front().value, p.low_95) << p.key;
    EXPECT_LT(p.high_95, profile.points.back().value) << p.key;
    EXPECT_LT(p.low_95, profile.top) << p.key;
    EXPECT_LT(profile.top, p.high_95) << p.key;
  }
}

TEST(SensedDiagnosis, EveryKindOfParameterIsWithinItsIntervalAndThatOfItsProfile) {
  Diagnosis d;
  for (const char* key : {"s_x", "s_a_x", "s_2_y", "s_T_z", "D_F_x", "D_IS_z", "eta_y", "K0_x"})
    add_cause(d, key);
  sense(d, {});
  expect_one_story(d);
  const auto of = [&](std::string_view key) -> const CauseParameter& {
    return std::ranges::find(d.causes, key, &search::Cause::term)->parameters[0];
  };
  // What bends a scale factor: the other sign, the ends of the interval exchanged.
  for (const char* key : {"s_a_x", "s_2_y", "s_T_z"}) {
    EXPECT_NEAR(of(key).value, -3.0, 1e-12) << key;
    EXPECT_NEAR(of(key).low_95, -5.0, 1e-12) << key;
    EXPECT_NEAR(of(key).high_95, -2.0, 1e-12) << key;
    EXPECT_NEAR(of(key).sigma, 0.5, 1e-9) << key;
    EXPECT_EQ(of(key).prior_sigmas, -4.0) << key;
  }
  // A scale factor: 1 / (1 + S) - 1, of ppm.
  const auto scale = [](double ppm) { return (1.0 / (1.0 + 1e-6 * ppm) - 1.0) * 1e6; };
  EXPECT_NEAR(of("s_x").value, scale(3.0), 1e-9);
  EXPECT_NEAR(of("s_x").low_95, scale(5.0), 1e-9);
  EXPECT_NEAR(of("s_x").high_95, scale(2.0), 1e-9);
  // A drift by the scale factor, which is itself a cause; other things as they are.
  EXPECT_NEAR(of("D_F_x").value, 3.0 / (1.0 + 3e-6), 1e-12);
  EXPECT_NEAR(of("D_F_x").high_95, 5.0 / (1.0 + 3e-6), 1e-12);
  EXPECT_EQ(of("D_F_x").prior_sigmas, 4.0);
  EXPECT_EQ(of("eta_y").value, 3.0);
  EXPECT_EQ(of("K0_x").high_95, 5.0);
}

TEST(SensedDiagnosis, AnEndThatIsNotKnownStaysUnknownOnTheOtherSide) {
  Diagnosis d;
  add_cause(d, "s_a_x");
  d.causes[0].parameters[0].high_95 = d.profiles[0].high_95 = nan_value;
  sense(d, {});
  EXPECT_TRUE(std::isnan(d.causes[0].parameters[0].low_95));
  EXPECT_NEAR(d.causes[0].parameters[0].high_95, -2.0, 1e-12);
  EXPECT_TRUE(std::isnan(d.profiles[0].low_95));
}

TEST(SensedDiagnosis, TheCommonDriftGoesOutOfIntervalsAndProfilesOfItsSetAlone) {
  Diagnosis d;
  add_cause(d, "D_I_x", 0, 10.0);
  add_cause(d, "D_I_y", 0, 20.0);
  add_cause(d, "D_I_z", 0, 60.0);
  add_cause(d, "D_I_x", 1, 7.0);
  take_common_drift_out(d);
  expect_one_story(d);
  EXPECT_NEAR(d.causes[0].parameters[0].value, -20.0, 1e-12);
  EXPECT_NEAR(d.causes[0].parameters[0].low_95, -21.0, 1e-12);
  EXPECT_NEAR(d.profiles[2].high_95, 32.0, 1e-12);
  EXPECT_EQ(d.causes[3].parameters[0].value, 7.0);
  EXPECT_EQ(d.profiles[3].top, 6.9);
  for (std::size_t k = 0; k < 4; ++k) {  // and it is known of which numbers
    EXPECT_EQ(d.causes[k].parameters[0].less_mean, k < 3) << k;
    EXPECT_EQ(d.profiles[k].less_mean, k < 3) << k;
  }
  EXPECT_NE(diagnosis::remark_in<diagnosis::remark::CommonDriftUnseen>(d), nullptr);
}

TEST(SensedDiagnosis, TheCommonDriftGoesOutOfParametersThatMovedOfEachFitItsOwn) {
  Diagnosis d;
  for (const auto& [key, before, after] : {std::tuple{"D_I_x", 10.0, 31.0},
                                           {"D_F_x", 5.0, 6.0},
                                           {"D_I_y", 20.0, 40.0},
                                           {"D_I_z", 60.0, 97.0}})
    d.fit.shifted.push_back(
        {key, "deg/h/g", *TermLibrary::find(key), before, 2.0, after, 0.5, 0.0});
  take_common_drift_out(d);
  EXPECT_NEAR(d.fit.shifted[0].before, -20.0, 1e-12);
  EXPECT_NEAR(d.fit.shifted[0].after, -25.0, 1e-12);
  EXPECT_NEAR(d.fit.shifted[0].shift_sigma, -2.5, 1e-12);
  EXPECT_NEAR(d.fit.shifted[3].after, 41.0, 1e-12);
  EXPECT_EQ(d.fit.shifted[1].after, 6.0);
  EXPECT_NE(diagnosis::remark_in<diagnosis::remark::CommonDriftUnseen>(d), nullptr);
}

TEST(SensedDiagnosis, OfAConsumersUnitAFoundSizeWidensAConsumersPriorAndNoNarrowerOne) {
  const std::size_t s_a = *TermLibrary::find("s_a_x");
  const double ppm = TermLibrary::specs[s_a].unit.to_si, usual = consumer_prior(s_a).sigma();
  FilterSpec nominal, believed;
  take_consumer_priors(believed);
  search::Cause cause;
  for (const double size : {0.1 * usual, 5.0 * usual}) {
    cause.parameters = {CauseParameter{"s_a_x", s_a, -size / ppm, 1.0, "ppm"}};
    const FilterSpec patched = diagnosis::patched_filter(nominal, {cause}, believed);
    EXPECT_NEAR(patched.priors[s_a].sigma(), std::max(size, usual), 1e-12);
  }
}

}  // namespace
}  // namespace drift::strapdown::sensed_diagnosis_test
