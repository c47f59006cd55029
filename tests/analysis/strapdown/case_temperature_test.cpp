// A strapdown unit whose temperature moves: what follows it beyond the first order is found, in the
// sensors' convention, and where it hardly moves is said not to have been looked for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "analysis/inference/thresholds.hpp"
#include "analysis/strapdown/case_diagnose.hpp"
#include "core/config/load.hpp"
#include "tests/support/strapdown_recording.hpp"

namespace drift::strapdown::case_temperature_test {
namespace {

mc::Study study() {
  const std::string text = R"(schema = 1
[site]
latitude = "34 deg"
[plan]
kind = "strapdown"
[[filter]]
name = "nominal"
coupling = "eq5"
terms = ["fixed_drift", "gyro_misalignment", "torquer_scale", "accelerometer"]
)";
  return mc::read_study_tree(config::parse_document(text, "study.toml"), "study.toml");
}

/// What a sensor adds to a row: deviation and rate of the temperature [K, K/s], what the gyro reads
/// [rad/s], specific force [g].
using Added = std::function<double(double dT, double rate, double reading)>;

/// A navigation-grade unit, moved for eighteen minutes. Its temperature swings twice by `swing`
/// from the lowest to the highest and is read in steps of `step` [K].
Recording recording_of(const mc::Study& study, double swing, const std::string& channel,
                       const Added& added, double step = 0.0) {
  test::StrapdownScript script;
  script.dwells = 16;
  script.rest = 60.0;
  script.turn = 8.0;
  script.interval = 0.05;
  script.gyro_noise = 3e-7;
  script.acc_noise = 1e-5;
  script.omega_ie_l = study.site.omega_ie_l();
  script.gravity = study.site.gravity;
  Theta theta = Theta::Zero();
  for (const auto& [key, value] :
       {std::pair{"D_F_x", 0.2}, {"D_F_z", -0.1}, {"s_y", 30.0}, {"eta_x", 20.0}, {"K0_z", 40.0}})
    test::set(theta, key, value);
  Recording r = strapdown_recording(script, theta);
  const std::vector<double>& time = r.channels[0].values;
  const double w = 4.0 * std::numbers::pi / time.back();
  Channel temperature{"temperature", *parse_unit("degC"), {}};
  const auto sensor = std::ranges::find(r.channels, channel, &Channel::name);
  for (std::size_t k = 0; k < time.size(); ++k) {
    const double dT = 0.5 * swing * std::sin(w * time[k]);
    const double rate = 0.5 * swing * w * std::cos(w * time[k]);
    temperature.values.push_back(step > 0.0 ? step * std::round((25.0 + dT) / step) : 25.0 + dT);
    if (sensor != r.channels.end()) sensor->values[k] += added(dT, rate, sensor->values[k]);
  }
  r.channels.push_back(std::move(temperature));
  return r;
}

diagnosis::Diagnosis diagnosed(const mc::Study& study, const Recording& recording) {
  return diagnose_case(study, identify_case(study, case_study(study, recording)));
}

/// One cause, that term of that axis, and its parameter within four sigma.
void expect_named(const diagnosis::Diagnosis& d, std::string_view term, std::string_view axis,
                  std::string_view key, double truth) {
  ASSERT_EQ(d.verdict, diagnosis::Verdict::named) << term;
  ASSERT_EQ(d.causes.size(), 1u) << term;
  EXPECT_EQ(d.causes[0].term, term);
  EXPECT_EQ(d.causes[0].axis, axis) << term;
  const auto p = std::ranges::find(d.causes[0].parameters, key, &search::CauseParameter::key);
  ASSERT_NE(p, d.causes[0].parameters.end()) << key;
  EXPECT_NEAR(p->value, truth, 4.0 * p->sigma) << key;
}

double si(double value, std::string_view unit) {
  return value * parse_unit(unit)->to_si;
}

TEST(CaseTemperature, WhatFollowsItIsNamedWithItsOrderAndItsSign) {
  const mc::Study s = study();
  const auto drift = [](double dT, double, double) { return si(0.03, "deg/h/degC") * dT; };
  expect_named(diagnosed(s, recording_of(s, 16.0, "gyro_y", drift)), "temperature_drift", "y",
               "kT_y", 0.03);
  const auto square = [](double dT, double, double) { return si(2e-3, "deg/h/degC^2") * dT * dT; };
  expect_named(diagnosed(s, recording_of(s, 16.0, "gyro_x", square)), "temperature_drift_curve",
               "x", "kT2_x", 2e-3);
  const auto cube = [](double dT, double, double) {
    return si(-1e-4, "deg/h/degC^3") * dT * dT * dT;
  };
  expect_named(diagnosed(s, recording_of(s, 16.0, "gyro_z", cube)), "temperature_drift_curve", "z",
               "kT3_z", -1e-4);
  const auto scale = [](double dT, double, double reading) {
    return si(20.0, "ppm/degC") * dT * reading;
  };
  expect_named(diagnosed(s, recording_of(s, 16.0, "gyro_z", scale)), "torquer_temperature", "z",
               "s_T_z", 20.0);
  const auto bias = [](double dT, double, double) { return si(1.0, "ug/degC^2") * dT * dT; };
  const diagnosis::Diagnosis d = diagnosed(s, recording_of(s, 16.0, "acc_y", bias));
  expect_named(d, "accelerometer_temperature_curve", "y", "K0_T2_y", 1.0);
  // What it adds is taken out of what is held against gravity: what is left is noise, 1e-5 g a
  // sample, 1200 a dwell, and a tenth of it again for what is estimated of so few dwells.
  const diagnosis::ErrorOfKind& gravity = d.errors.back();
  EXPECT_GT(gravity.before, 5.0) << "of 64 ug/4 in the mean";
  EXPECT_LT(gravity.after, 3.0 * 10.0 / std::sqrt(1200.0));
}

TEST(CaseTemperature, HysteresisIsNamedThoughTheThermometerReadsInSteps) {
  const mc::Study s = study();
  for (const double step : {0.0, 0.0625}) {
    const auto drift = [](double, double rate, double) { return si(0.1, "deg/h*min/degC") * rate; };
    expect_named(diagnosed(s, recording_of(s, 16.0, "gyro_x", drift, step)),
                 "temperature_rate_drift", "x", "kT_rate_x", 0.1);
    const auto bias = [](double, double rate, double) { return si(60.0, "ug*min/degC") * rate; };
    expect_named(diagnosed(s, recording_of(s, 16.0, "acc_z", bias, step)),
                 "accelerometer_temperature_rate", "z", "K0_T_rate_z", 60.0);
  }
}

TEST(CaseTemperature, AUnitThatDoesNotFollowItIsConsistent) {
  const mc::Study s = study();
  const diagnosis::Diagnosis d = diagnosed(s, recording_of(s, 16.0, "", {}));
  EXPECT_EQ(d.verdict, diagnosis::Verdict::consistent);
}

/// Limits of TemperatureLimits, from both sides.
TEST(CaseTemperature, OneThatHardlyMovesIsLookedAtInFirstOrderAndTheRestIsSaid) {
  const mc::Study s = study();
  for (const double swing : {2.9, 3.1}) {
    const diagnosis::Diagnosis d = diagnosed(s, recording_of(s, swing, "", {}));
    std::vector<std::string_view> terms;
    for (const diagnosis::NotExamined& n : d.not_examined)
      if (n.why == diagnosis::NotExamined::Why::no_swing) {
        terms.push_back(n.term);
        EXPECT_TRUE(n.twins.empty());
      }
    const std::vector<std::string_view> all{
        "temperature_drift_curve", "temperature_rate_drift", "torquer_temperature",
        "accelerometer_temperature_curve", "accelerometer_temperature_rate"};
    EXPECT_EQ(terms, swing < 3.0 ? all : std::vector<std::string_view>{});
  }
}

}  // namespace
}  // namespace drift::strapdown::case_temperature_test
