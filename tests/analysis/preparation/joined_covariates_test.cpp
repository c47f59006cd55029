// What several recordings carry together.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/preparation/prepare.hpp"
#include "analysis/preparation/recorded_test.hpp"
#include "core/plan/environment.hpp"
#include "core/sim/simulate.hpp"
#include "core/sim/surroundings.hpp"
#include "tests/support/own_terms.hpp"
#include "tests/support/rows_at_any_distance.hpp"
#include "tests/support/six_positions.hpp"
#include "tests/support/term_scenes.hpp"

namespace drift::preparation::joined_covariates_test {
namespace {

mc::Study study() {
  mc::Study s = test::slewing_study(600.0, Coupling::eq5, Coupling::eq5);
  s.truth.active = test::only({"D_F"});
  return s;
}

Recording recorded(double warmer = 0.0) {
  const mc::Study s = study();
  Timeline timeline = lay_out(s.plan, s.site);
  Environment day = test::harbin_day();
  *day[covariate("temperature")].mean.front() += warmer;
  set_environment(timeline, day, 1, 0);
  const Simulation sim = Simulator(s.truth, s.readout).run(timeline, 1, 0);
  return make_recording(timeline, sim.measured, s.readout);
}

TEST(JoinedCovariates, AreThoseThatEveryRecordingHas) {
  const test::OwnTermsHeld held(
      test::own_term("twin", "drift.y", "A*oven_sensor", "A = { unit = 'deg/h/K', prior = 0.03 }"));
  Recording with = recorded();
  Channel column = *with.find("temperature");
  column.name = "oven_sensor";
  with.channels.push_back(column);
  const CovariateSet both = recorded_test(study(), {with, with}).timeline.carried;
  EXPECT_EQ(both, every_known_covariate | further_column(0));
  EXPECT_EQ(recorded_test(study(), {with, recorded()}).timeline.carried, every_known_covariate);
}

TEST(JoinedCovariates, ThatOneRecordingLacksAreToldOfThatOne) {
  const test::OwnTermsHeld held(
      test::own_term("twin", "drift.y", "A*oven_sensor", "A = { unit = 'deg/h/K', prior = 0.03 }"));
  Recording with = recorded(), without = recorded();
  with.source = "with.csv";
  without.source = "without.csv";
  Channel column = *with.find("temperature");
  column.name = "oven_sensor";
  with.channels.push_back(column);
  std::erase_if(without.channels, [](const Channel& c) { return c.name == "temperature"; });
  DriftModel model;
  for (const char* term : {"accelerometer_temperature", "twin", "magnetic_drift"})
    model.terms.set(TermLibrary::find_term(term).value());
  const Timeline both = recorded_test(study(), {with, without}).timeline;
  EXPECT_EQ(both.lacking(covariate("temperature").set()), std::vector<std::size_t>{1});
  EXPECT_TRUE(both.lacking(covariate("field").set()).empty());
  const auto one = missing_covariates(model, both);
  ASSERT_EQ(one.size(), 2u);
  for (const std::string& text : one)
    EXPECT_NE(text.find(", which is not known in without.csv (expected a column"),
              std::string::npos)
        << text;
  // Where none has it there is no use in naming them.
  const auto all = missing_covariates(model, recorded_test(study(), {without, without}).timeline);
  ASSERT_EQ(all.size(), 2u);
  for (const std::string& text : all)
    EXPECT_NE(text.find(", which is not known (expected a column"), std::string::npos) << text;
}

/// A loop that removed 40 arcsec of eta_x, or nothing.
Recording recorded_in_a_loop(const std::string& file, double eta_x = 40.0 * test::arcsec) {
  mc::Study s = study();
  s.truth.coupling = Coupling::compensated;
  s.truth.theta_loop[test::param("eta_x")] = eta_x;
  Timeline timeline = lay_out(s.plan, s.site);
  set_loop(timeline, s.truth);
  const Simulation sim = Simulator(s.truth, s.readout).run(timeline, 1, 0);
  Recording r = make_recording(timeline, sim.measured, s.readout);
  r.source = file;
  return r;
}

TEST(RecordedLoop, IsAskedForByACompensatedFilterAlone) {
  DriftModel compensated, eq5;
  compensated.coupling = Coupling::compensated;
  eq5.coupling = Coupling::eq5;
  const Recording told = recorded_in_a_loop("told.csv");
  const Timeline known = recorded_test(study(), {told}).timeline;
  EXPECT_NEAR(known.intervals.back().loop[0], 40.0 * test::arcsec, 1e-6 * test::arcsec);
  EXPECT_TRUE(missing_covariates(compensated, known).empty());
  // A loop that removed nothing is told, too.
  const Recording nothing = recorded_in_a_loop("nothing.csv", 0.0);
  EXPECT_TRUE(
      missing_covariates(compensated, recorded_test(study(), {told, nothing}).timeline).empty());
  Recording some = told, none = recorded();
  some.source = "some.csv", none.source = "none.csv";
  std::erase_if(some.channels, [](const Channel& c) { return c.name == "loop_xi_z"; });
  for (const auto& [recordings, files] :
       {std::pair{std::vector{none}, "in none.csv (expected columns loop_eta_x"},
        std::pair{std::vector{told, some, none}, "in some.csv, none.csv (expected columns"}}) {
    const Timeline unknown = recorded_test(study(), recordings).timeline;
    EXPECT_TRUE(missing_covariates(eq5, unknown).empty());
    const auto wrong = missing_covariates(compensated, unknown);
    ASSERT_EQ(wrong.size(), 1u);
    EXPECT_NE(wrong[0].find(files), std::string::npos) << wrong[0];
    EXPECT_THROW(require_covariates(compensated, unknown), InputError);
  }
  // The plan of a study is no recording: what its loop removes [truth] says.
  EXPECT_TRUE(missing_covariates(compensated, lay_out(study().plan, study().site)).empty());
}

TEST(RecordedLoop, HasANumberInEveryRow) {
  Recording r = recorded_in_a_loop("gap.csv");
  const auto eta = std::ranges::find(r.channels, "loop_eta_x", &Channel::name);
  ASSERT_NE(eta, r.channels.end());
  eta->values[7] = std::nan("");
  try {
    recorded_test(study(), {r});
    FAIL() << "a loop of a row that nobody knows";
  } catch (const InputError& error) {
    ASSERT_EQ(error.messages().size(), 1u);
    EXPECT_NE(error.messages()[0].find("gap.csv:8: loop_eta_x"), std::string::npos)
        << error.messages()[0];
  }
}

TEST(JoinedCovariates, DeviateFromOneMean) {
  constexpr CovariateSpec temperature = covariate("temperature");
  constexpr double warmer = 4.0;  // [K] in the second recording
  const RecordedTest made = recorded_test(study(), {recorded(), recorded(warmer)});
  const std::size_t rows = made.ends.front();
  ASSERT_EQ(made.timeline.intervals.size(), 2 * rows);
  for (std::size_t k = 0; k < rows; ++k)
    EXPECT_NEAR(made.timeline.intervals[rows + k].around1[temperature],
                made.timeline.intervals[k].around1[temperature] + warmer, 1e-11);
  // It is that of both, whichever comes first: the drift at the mean is another number else.
  const RecordedTest turned = recorded_test(study(), {recorded(warmer), recorded()});
  EXPECT_NEAR(turned.timeline.mean[temperature], made.timeline.mean[temperature], 1e-11);
  for (std::size_t k = 0; k < rows; ++k)
    EXPECT_NEAR(turned.timeline.intervals[rows + k].around1[temperature],
                made.timeline.intervals[k].around1[temperature], 1e-11);
}

TEST(JoinedRecordings, BeginEachAnew) {
  const RecordedTest made = recorded_test(study(), {recorded(), recorded()});
  const auto& all = made.timeline.intervals;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const bool second = k >= made.ends.front();
    EXPECT_EQ(all[k].begins, k == 0 || k == made.ends.front()) << k;
    EXPECT_EQ(all[k].t_begin, all[second ? made.ends.front() : 0].t0) << k;
  }
}

/// A swing of 3 K and two hours moves by 0.08 K in half a minute, by which the mean over a joined
/// row is late: a hysteresis that nobody has. The line at its end misses its curvature alone, by
/// T'' L^2 / 12: of rows of 90 s at most 1.6e-3 K.
TEST(JoinedCovariates, OfFineRowsAreWhatTheyAreAtTheEndOfJoinedOnes) {
  constexpr double w = 2.0 * std::numbers::pi / 7200.0;
  mc::Study s = study();
  s.readout.accelerometer_noise = s.readout.gimbal_noise = 1e-12;
  Recording fine = test::second_by_second(s);
  Channel temperature{"temperature", "degC"_unit, {}};
  for (const double t : fine.find("time")->values)
    temperature.values.push_back(25.0 + 3.0 * std::sin(w * t));
  fine.channels.push_back(temperature);
  const auto expect_at_the_end = [&](const Recording& r, std::size_t but_for) {
    const Prepared p = prepare(s, {r});
    const Recording& joined = p.recordings.front();
    ASSERT_LT(joined.rows(), r.rows() / 20);
    for (std::size_t k = 0; k + but_for < joined.rows(); ++k)
      EXPECT_NEAR(joined.find("temperature")->values[k],
                  25.0 + 3.0 * std::sin(w * joined.find("time")->values[k]), 1.6e-3);
  };
  for (const test::Rows rows : {test::Rows::each_second, test::Rows::seconds_lost})
    expect_at_the_end(test::with_rows(fine, rows), 0);
  // Read in every tenth row; in the last nine it is held.
  for (std::size_t row = 0; row < fine.rows(); ++row)
    if (row % 10 != 0) test::channel(fine, "temperature")[row] = nan_value;
  expect_at_the_end(fine, 1);
}

TEST(PlannedTest, HasTheFieldThatWasRecordedWhereNoneIsDeclared) {
  constexpr CovariateSpec field = covariate("field");
  mc::Study s = study();
  const Timeline made = recorded_test(s, {recorded()}).timeline;
  const Vec3 there = made.intervals.front().around1.vector(field);
  EXPECT_GT((there - dipole_field_l(s.site.latitude)).norm(), 1e-6);
  const Timeline planned = planned_test(s, s.plan, made);
  ASSERT_TRUE(planned.carries(field));
  EXPECT_LT((planned.intervals.back().around0.vector(field) - there).norm(), 1e-16);
  s.environment[field].mean = {3e-5, 0.0, 0.0};
  EXPECT_EQ(planned_test(s, s.plan, made).intervals.back().around0.vector(field).x(), 3e-5);
}

}  // namespace
}  // namespace drift::preparation::joined_covariates_test
