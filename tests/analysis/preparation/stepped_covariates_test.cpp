// A thermometer that reads in steps.
#include "analysis/preparation/covariates/stepped_covariates.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/preparation/recorded_test.hpp"
#include "core/estimate/batch.hpp"
#include "core/plan/environment.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::preparation::stepped_covariates_test {
namespace {

constexpr double step = 0.0625;                 // [K]
const double hysteresis = 200.0 * 1e-6 * 60.0;  // [g s/K]: 200 ug*min/degC

mc::Study study() {
  mc::Study s = test::six_study();
  s.truth.active = test::only({"D_F", "K0_T_rate"});
  s.filters.front().active = s.truth.active;
  return s;
}

/// The accelerometer x follows the rate of the temperature.
Recording recorded(const mc::Study& s) {
  return test::simulated_in_a_swing(
      s, {{"K0_T_rate_x", hysteresis}, {"K0_T_rate_y", 0.0}, {"K0_T_rate_z", 0.0}});
}

Recording in_steps(Recording r) {
  for (double& x : test::channel(r, "temperature")) x = step * std::round(x / step);
  return r;
}

ParameterEstimate estimated(const mc::Study& s, const Recording& r) {
  const Prepared p = prepare(s, {r});
  const RecordedTest t = recorded_test(p.study, p.recordings);
  const BatchResult fit = fit_batch(p.study.filters[0], {t.timeline, p.study.readout, t.measured},
                                    make_layout(p.study.filters[0]).theta);
  return *fit.estimate.find(test::param("K0_T_rate_x"));
}

/// From row to row the steps are half of what the temperature moves by: what follows its rate came
/// out a quarter too small, five sigma.
TEST(SteppedCovariates, HideNoHysteresis) {
  const mc::Study s = study();
  const Recording r = recorded(s);
  const ParameterEstimate fine = estimated(s, r), stepped = estimated(s, in_steps(r));
  EXPECT_NEAR(fine.value, hysteresis, 4.0 * fine.sigma);
  EXPECT_NEAR(stepped.value, hysteresis, 4.0 * stepped.sigma);
  EXPECT_NEAR(stepped.value, fine.value, fine.sigma);
}

TEST(SteppedCovariates, AreSaidAndOthersAreLeftAsTheyAre) {
  const mc::Study s = study();
  const Recording r = recorded(s);
  const Prepared fine = prepare(s, {r});
  EXPECT_EQ(fine.recordings.front().find("temperature")->values, r.find("temperature")->values);
  EXPECT_FALSE(test::says(fine, "in steps"));
  const Prepared stepped = prepare(s, {in_steps(r)});
  EXPECT_TRUE(test::says(stepped, "the temperature is read in steps of 0.0625 degC"));
}

/// Of a room that warms up along one parabola in 246 min the widest window is best: 477 min to both
/// sides of a row were said.
TEST(SteppedCovariates, OneParabolaThroughAllIsCalledThat) {
  const auto remark_of = [](double rise, double swing) {
    Recording r;
    r.channels = {{"time", unit::s, {}}, {"temperature", "degC"_unit, {}}};
    for (int k = 1; k <= 123; ++k) {
      const double u = k / 123.0;
      r.channels[0].values.push_back(120.0 * k);
      r.channels[1].values.push_back(
          0.1 * std::round((20.0 + rise * u - u * u + swing * std::sin(30.0 * u)) / 0.1));
    }
    std::vector<Recording> recordings{r};
    std::vector<std::string> remarks;
    take_smooth(stepped_covariates(recordings), recordings, remarks);
    return remarks.size() == 1 ? remarks.front() : "no remark";
  };
  const std::string wide = remark_of(2.0, 0.0), narrow = remark_of(3.0, 1.0);
  EXPECT_TRUE(wide.ends_with("taken from one parabola through all that was read")) << wide;
  EXPECT_TRUE(narrow.ends_with("the parabolas through 5.26 min to both sides of a row")) << narrow;
}

}  // namespace
}  // namespace drift::preparation::stepped_covariates_test
