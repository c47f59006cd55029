// What hangs on a covariate is not fitted where that is not known.
#include "analysis/preparation/covariates/unknown_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/preparation/recorded_test.hpp"
#include "core/base/check.hpp"
#include "core/estimate/batch.hpp"
#include "core/plan/environment.hpp"
#include "tests/support/own_terms.hpp"
#include "tests/support/rows_at_any_distance.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::preparation::unknown_rows_test {
namespace {

constexpr double per_degree = 100e-6;  // [g/K] of the accelerometer x

/// Six caged positions of 20 rows a minute each.
mc::Study study(std::initializer_list<std::string_view> parameters) {
  mc::Study s = test::six_study();
  s.truth.active = s.filters.front().active = test::only(parameters);
  return s;
}

Recording recorded(const mc::Study& s) {
  const bool follows = s.truth.active[test::param("K0_T_x")];
  return test::simulated_in_a_swing(s, {{"K0_T_x", follows ? per_degree : 0.0}});
}

Recording without(Recording r, std::string_view column, std::size_t first, std::size_t end) {
  std::vector<double>& x = test::channel(r, column);
  std::fill(x.begin() + static_cast<std::ptrdiff_t>(first),
            x.begin() + static_cast<std::ptrdiff_t>(end), nan_value);
  return r;
}

/// Rows first up to end, and they alone, have neither accelerometers nor gimbals.
void expect_left_out(const Recording& r, std::size_t first, std::size_t end) {
  for (const char* name : {"acc_x", "acc_z", "gimbal_outer", "gimbal_inner"})
    for (std::size_t row = 0; row < r.rows(); ++row)
      EXPECT_EQ(std::isnan(r.find(name)->values[row]), row >= first && row < end)
          << name << " " << row;
}

TEST(UnknownRows, AreLeftOutForTermsThatFollowWhatIsUnknown) {
  const mc::Study acc = study({"D_F", "K0", "K0_T"}), drift = study({"D_F", "kT"}),
                  none = study({"D_F"});
  // A row begins with what the row before ends with.
  const Prepared bias = prepare(acc, {without(recorded(acc), "temperature", 45, 50)});
  expect_left_out(bias.recordings[0], 45, 51);
  EXPECT_TRUE(test::says(bias,
                         "temperature has no reading in 5 of 120 rows (5 min, at a stretch 5 min "
                         "from line 46 on)"));
  EXPECT_TRUE(test::says(bias,
                         "6 of 120 rows are left out of the fit, for accelerometer_temperature "
                         "follows it"));
  // Nobody knows how it drifted: the position ends with row 59, and the next is caged.
  const Prepared drifted = prepare(drift, {without(recorded(drift), "temperature", 45, 50)});
  expect_left_out(drifted.recordings[0], 45, 60);
  EXPECT_TRUE(test::says(drifted, "up to where the platform is caged anew, for temperature_drift"));
  // One reading that is missing is bridged, and said; what nobody follows is nobody's loss.
  const Prepared one = prepare(acc, {without(recorded(acc), "temperature", 45, 46)});
  expect_left_out(one.recordings[0], 0, 0);
  EXPECT_TRUE(test::says(one, "no farther from one than is usual; accelerometer_temperature"));
  const Prepared nobody = prepare(none, {without(recorded(none), "temperature", 45, 50)});
  expect_left_out(nobody.recordings[0], 0, 0);
  EXPECT_FALSE(test::says(nobody, "has no reading"));
}

/// The thermometer stops in the middle: held at its last reading, it was off by 5 K at the end, and
/// chi-square was 12.
TEST(UnknownRows, DoNotMoveWhatIsEstimated) {
  const mc::Study s = study({"D_F", "K0", "K0_T"});
  const Prepared p = prepare(s, {without(recorded(s), "temperature", 61, 120)});
  expect_left_out(p.recordings[0], 62, 120);
  const RecordedTest t = recorded_test(p.study, p.recordings);
  const BatchResult fit = fit_batch(p.study.filters[0], {t.timeline, p.study.readout, t.measured},
                                    make_layout(p.study.filters[0]).theta);
  const ParameterEstimate& k = *fit.estimate.find(test::param("K0_T_x"));
  EXPECT_NEAR(k.value, per_degree, 4.0 * k.sigma);
  const auto m = static_cast<double>(fit.estimate.measured);
  EXPECT_NEAR(fit.estimate.statistic_per_dof(), 1.0, 4.0 * std::sqrt(2.0 / m));
}

TEST(UnknownRows, OfAnOwnColumnToo) {
  const test::OwnTermsHeld held(test::own_term("heated", "accelerometer.y", "A*oven_sensor",
                                               "A = { unit = 'ug/K', prior = 30 }"));
  mc::Study s = study({"D_F", "heated_A"});
  s.truth.active = test::only({"D_F"});
  Recording r = recorded(s);
  Channel column = *r.find("temperature");
  column.name = "oven_sensor";
  r.channels.push_back(column);
  const Prepared p = prepare(s, {without(r, "oven_sensor", 45, 50)});
  expect_left_out(p.recordings[0], 45, 51);
  EXPECT_TRUE(test::says(p, "oven_sensor has no reading in 5 of 120 rows"));
  EXPECT_TRUE(test::says(p, "for heated follows it"));
}

/// A diagnosis looks for terms that the filter has not: for these it leaves rows out as long as
/// most remain, and else the column.
TEST(UnknownRows, OfADiagnosisCostTheLesserPart) {
  const mc::Study s = study({"D_F"});
  const auto ready = [&](std::size_t first, std::size_t end) {
    return prepare(s, {without(recorded(s), "temperature", first, end)}, RecordingLimits::most_rows,
                   Following::library);
  };
  const Prepared few = ready(45, 50);
  expect_left_out(few.recordings[0], 45, 60);
  EXPECT_TRUE(test::says(few, "terms that are looked for follow it"));
  EXPECT_TRUE(few.unused.empty());
  const Prepared most = ready(30, 120);
  expect_left_out(most.recordings[0], 0, 0);
  EXPECT_EQ(most.recordings[0].find("temperature"), nullptr);
  EXPECT_TRUE(test::says(most, "taken as not recorded"));
  ASSERT_EQ(most.unused.size(), 1u);
  EXPECT_EQ(most.unused[0].set, covariate("temperature").set());
}

/// Where the attitude is carried on from the beginning to the end, nothing is left behind a gap.
TEST(UnknownRows, AreRefusedWhereNoRowIsLeft) {
  mc::Study s = test::slewing_study(600.0, Coupling::eq5, Coupling::eq5);
  s.truth.active = test::only({"D_F"});
  const auto parameters = [&](std::string_view group) {
    s.filters.front().active = test::only({"D_F", group});
  };
  const Recording r = without(recorded(s), "temperature", 0, 5);
  parameters("K0_T");
  expect_left_out(prepare(s, {r}).recordings[0], 0, 5);
  parameters("kT");
  try {
    prepare(s, {r});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::recording);
    EXPECT_NE(std::string(error.what()).find("temperature_drift follows it: then no row is left"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace drift::preparation::unknown_rows_test
