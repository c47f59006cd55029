// A consumer's gyros, whose drift follows the temperature while the case rests for a minute.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/report/diagnosis/words/sentence.hpp"
#include "analysis/strapdown/case_diagnose.hpp"
#include "tests/support/strapdown_recording.hpp"

namespace drift::strapdown::consumer_temperature_test {
namespace {

/// Eighteen minutes with rests of 50 s, in which gyro z follows a swing of 8 K and nine minutes,
/// and its rate.
Recording warmed(double kT, double kT_rate) {
  Theta theta = Theta::Zero();
  for (const char* key : {"D_F_x", "D_F_y", "D_F_z"}) test::set(theta, key, 900.0);
  test::set(theta, "s_x", 4000.0);
  Recording r = test::strapdown_recording(
      {.dwells = 20, .rest = 50.0, .interval = 0.04, .gyro_noise = 0.003, .seed = 11}, theta);
  Channel temperature{"temperature", *parse_unit("degC"), {}};
  const auto gyro = std::ranges::find(r.channels, "gyro_z", &Channel::name);
  const std::vector<double> time = r.channels[0].values;
  for (std::size_t k = 0; k < time.size(); ++k) {
    constexpr double w = 2.0 * std::numbers::pi / 540.0;
    const double dT = 8.0 * std::sin(w * time[k]), rate = 8.0 * w * std::cos(w * time[k]);
    temperature.values.push_back(25.0 + dT);
    gyro->values[k] += kT * dT + kT_rate * rate;
  }
  r.channels.push_back(std::move(temperature));
  return r;
}

TEST(ConsumerTemperature, ADriftThatFollowsItIsNamedWithItsSizeAndNoLag) {
  // Of a data sheet. Gyros are read over whole rests, and so is the temperature: taken over halves
  // of them it ran 12 s ahead, and a hysteresis was missing, too.
  const mc::Study study =
      mc::read_study(std::string(DRIFT_SOURCE_DIR) + "/configs/diagnose_xsens.toml");
  const double unit = parse_unit("deg/h/degC")->to_si;
  const Recording recording = warmed(60.0 * unit, 0.0);
  const diagnosis::Diagnosis d =
      diagnose_case(study, identify_case(study, case_study(study, recording)));
  EXPECT_EQ(d.verdict, diagnosis::Verdict::named) << report::sentence(d);
  ASSERT_EQ(d.causes.size(), 1u) << report::sentence(d);
  EXPECT_EQ(d.causes[0].term, "temperature_drift") << report::sentence(d);
  const auto p = std::ranges::find(d.causes[0].parameters, "kT_z", &search::CauseParameter::key);
  ASSERT_NE(p, d.causes[0].parameters.end());
  EXPECT_NEAR(p->value, 60.0, 4.0 * p->sigma);
  EXPECT_LT(p->sigma, 1.5);
}

TEST(ConsumerTemperature, OneThatFollowsItsRateHasItsSize) {
  mc::Study study = mc::read_study(std::string(DRIFT_SOURCE_DIR) + "/configs/diagnose_xsens.toml");
  FilterSpec& filter = study.filters.front();
  for (const char* key : {"kT_z", "kT_rate_z"}) filter.active.set(*TermLibrary::find(key));
  filter.priors[*TermLibrary::find("kT_rate_z")] =
      normal(0.0, 100.0 * parse_unit("deg/h*min/degC")->to_si);
  const Recording recording = warmed(0.0, 30.0 * parse_unit("deg/h*min/degC")->to_si);
  const CaseIdentification id = identify_case(study, case_study(study, recording));
  const ParameterEstimate* p = id.fits.front().fit.estimate.find(*TermLibrary::find("kT_rate_z"));
  ASSERT_NE(p, nullptr);
  EXPECT_NEAR(p->value, 30.0 * parse_unit("deg/h*min/degC")->to_si, 4.0 * p->sigma);
  EXPECT_LT(p->sigma, 3.0 * parse_unit("deg/h*min/degC")->to_si);
}

}  // namespace
}  // namespace drift::strapdown::consumer_temperature_test
