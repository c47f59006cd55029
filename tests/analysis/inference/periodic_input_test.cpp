#include "analysis/inference/periodic_input.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "analysis/search/fitted.hpp"
#include "tests/support/model_builders.hpp"
#include "tests/support/own_terms.hpp"

namespace drift::inference::periodic_input_test {
namespace {

using namespace drift::test;

constexpr double period = 23.7 * 60.0;  // [s]: divides neither dwell nor test

/// A test with what a model leaves of it.
search::Fitted examined(const Timeline& timeline, const Measurements& measured,
                        const Readout& readout = {}) {
  const FilterSpec filter = base_filter(Coupling::eq5);
  const MeasuredTest test{timeline, readout, measured};
  const BatchResult fit = fit_batch(filter, test, make_layout(filter).theta);
  return search::examine(filter, test, fit, NoiseEstimate{});
}

struct Disturbance {
  Equation equation;
  int axis;
  const char *acts_on, *unit;
  double amplitude;  ///< in `unit`: some ten sigmas of the whole test
};

TEST(PeriodicInput, IsFoundInItsEquationWithPeriodAndSize) {
  const Timeline timeline = preset_timeline("twelve", CommandLaw::free);
  const double span = timeline.intervals.back().t1;
  for (const Disturbance& d :
       {Disturbance{Equation::gimbal, 2, "gimbal.inner", "arcsec", 3.0},
        Disturbance{Equation::accelerometer, 0, "accelerometer.x", "ug", 3.0},
        Disturbance{Equation::rate, 1, "drift.y", "deg/h", 0.02}}) {
    SCOPED_TRACE(d.acts_on);
    TruthSpec truth = base_truth(Coupling::eq5);
    const OwnTermsHeld held(
        own_term("hum", d.acts_on, "A*sin(2*pi*t/P + 1)",
                 fmt::format("A = {{ unit = '{}', value = {} }}, P = {{ unit = 's', value = {} }}",
                             d.unit, d.amplitude, period)));
    for (const char* key : {"hum_A", "hum_P"}) {
      truth.active.set(param(key));
      truth.priors[param(key)] = TermLibrary::specs[param(key)].prior_si();
    }
    const Simulation run = Simulator(truth, {}).run(timeline, 5, 0);
    ASSERT_TRUE(run.ode.ok());
    const search::Fitted e = examined(timeline, run.measured);
    const PeriodicInput found = strongest_periodic_input(e.problem, *e.projector);
    EXPECT_EQ(equation_name(found.equation, found.axis), equation_name(d.equation, d.axis));
    EXPECT_LT(found.p_value(), 1e-9);
    // Scores fall by T pi^2 x^2 / 3 where the frequency is x cycles per test off.
    const double z = std::sqrt(found.T), of_noise = std::sqrt(3.0) / (std::numbers::pi * z),
                 of_grid = 1.0 / 16.0;
    EXPECT_LT(std::abs(span / found.period_s - span / period), 4.0 * of_noise + of_grid);
    EXPECT_NEAR(found.amplitude() / unit_of(d.equation).to_si, d.amplitude, 4.0 * d.amplitude / z);
    // Of a size that two decades hold the evidence is what the gain leaves after ln 100 and z^2.
    EXPECT_NEAR(found.log_evidence(), found.log_gain() - std::log(found.T * std::log(100.0)), 1e-6);
  }
}

/// Rows missing from every dwell lengthen no period that can be seen.
TEST(PeriodicInput, IsFoundBetweenGaps) {
  const Timeline timeline = preset_timeline("twelve", CommandLaw::free, 1200.0);
  Measurements measured = Simulator(base_truth(Coupling::eq5), {}).run(timeline, 6, 0).measured;
  constexpr double fast = 200.0;
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    measured.gimbal(2, at) +=
        8.0 * arcsec * std::sin(2.0 * std::numbers::pi * timeline.intervals[i].t1 / fast);
    if (i % 20 >= 6 && i % 20 < 18) {
      measured.gimbal.col(at).setConstant(std::nan(""));
      measured.acc.col(at).setConstant(std::nan(""));
    }
  }
  const search::Fitted e = examined(timeline, measured);
  const PeriodicInput found = strongest_periodic_input(e.problem, *e.projector);
  EXPECT_EQ(equation_name(found.equation, found.axis), "gimbal inner");
  EXPECT_NEAR(found.period_s, fast, 0.01 * fast);
  EXPECT_LT(found.p_value(), 1e-9);
}

/// Time goes on while nothing is recorded, between positions.
TEST(PeriodicInput, IsDatedByTheClockOfTheTest) {
  const Timeline timeline = preset_timeline("six", CommandLaw::free, 600.0);
  Measurements measured = Simulator(base_truth(Coupling::eq5), {}).run(timeline, 9, 0).measured;
  constexpr double fast = 190.0, height = 100.0 * arcsec;
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i)
    measured.gimbal(1, static_cast<Eigen::Index>(i)) +=
        height * std::sin(2.0 * std::numbers::pi * timeline.intervals[i].t1 / fast);
  search::Fitted e = examined(timeline, measured);
  const PeriodicInput together = strongest_periodic_input(e.problem, *e.projector);
  ASSERT_EQ(equation_name(together.equation, together.axis), "gimbal middle");
  // The same readings, a sinusoid that stands still for an hour between the positions.
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i) {
    const double t = timeline.intervals[i].t1, later = t + 3600.0 * timeline.intervals[i].position;
    measured.gimbal(1, static_cast<Eigen::Index>(i)) +=
        height * (std::sin(2.0 * std::numbers::pi * later / fast) -
                  std::sin(2.0 * std::numbers::pi * t / fast));
    if (i > 0 && timeline.intervals[i].position != timeline.intervals[i - 1].position)
      e.problem.drives[i].gap += 3600.0;
  }
  search::Fitted apart = examined(timeline, measured);
  apart.problem.drives = e.problem.drives;
  const PeriodicInput found =
      strongest_periodic_input(apart.problem, Projector(apart.problem, NoiseModel{}));
  EXPECT_EQ(equation_name(found.equation, found.axis), "gimbal middle");
  EXPECT_NEAR(found.period_s, fast, 0.01 * fast);
  // A tenth of the rows an hour late would cost a tenth of the height.
  EXPECT_NEAR(found.amplitude(), height, 4.0 * height / std::sqrt(found.T));
}

/// How long after the one before a recording begins nobody knows: what is found depends on no
/// order.
TEST(PeriodicInput, IsDatedByTheClockOfItsRecording) {
  const Timeline timeline = preset_timeline("six", CommandLaw::free, 600.0);
  Measurements measured = Simulator(base_truth(Coupling::eq5), {}).run(timeline, 9, 0).measured;
  constexpr double fast = 190.0, height = 100.0 * arcsec;
  const auto second = std::ranges::find(timeline.intervals, timeline.intervals.front().position + 3,
                                        &Interval::position);
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i) {
    const double t = timeline.intervals[i].t1,
                 own = t > second->t0 ? t - second->t0 : t;  // half a cycle off the other's
    measured.gimbal(1, static_cast<Eigen::Index>(i)) +=
        height * std::sin(2.0 * std::numbers::pi * own / fast);
  }
  search::Fitted e = examined(timeline, measured);
  e.problem.drives[static_cast<std::size_t>(second - timeline.intervals.begin())].begins = true;
  const PeriodicInput found =
      strongest_periodic_input(e.problem, Projector(e.problem, NoiseModel{}));
  EXPECT_EQ(equation_name(found.equation, found.axis), "gimbal middle");
  EXPECT_NEAR(found.period_s, fast, 0.01 * fast);
  EXPECT_NEAR(found.amplitude(), height, 4.0 * height / std::sqrt(found.T));
}

/// By Davies' bound the chance is at most as stated; the spectrum misses little of what is there.
TEST(PeriodicInput, IsThereByChanceAsOftenAsItSays) {
  const Timeline timeline = preset_timeline("six", CommandLaw::free, 1800.0);
  const Simulation run = Simulator(base_truth(Coupling::eq5), {}).run(timeline, 8, 0);
  search::Fitted e = examined(timeline, run.measured);
  NoiseModel wandering;
  wandering.drift_random_walk = 0.01 * deg_per_h / 60.0;
  constexpr int draws = 300;
  for (const NoiseModel& noise : {NoiseModel{}, wandering}) {
    Stream random(20, 0, Purpose::test);
    int low = 0, lower = 0;
    for (int k = 0; k < draws; ++k) {
      VecX z(e.problem.rows()), x(e.problem.theta.cols());
      for (double& v : z) v = random.normal();
      for (double& v : x) v = random.normal();
      LinearProblem p = e.problem.bare();
      p.r0 = Whitener(p, noise).colour(z) + p.theta * x;
      const double chance = strongest_periodic_input(p, Projector(p, noise)).p_value();
      low += chance < 0.1;
      lower += chance < 0.02;
    }
    // Four sigmas of 300 draws.
    EXPECT_LE(low, draws * 0.1 + 4.0 * std::sqrt(draws * 0.1));
    EXPECT_LE(lower, draws * 0.02 + 4.0 * std::sqrt(draws * 0.02));
    EXPECT_GE(low, 3) << "of 30 by a bound that is tight: the strongest lines are not looked at";
  }
}

TEST(PeriodicInput, IsNotLookedForWhereRoundingComesBack) {
  const Timeline timeline = preset_timeline("six", CommandLaw::free, 1800.0);
  const Simulation run = Simulator(base_truth(Coupling::eq5), {}).run(timeline, 8, 0);
  Readout rounded;
  rounded.gimbals_rounded = true;
  const search::Fitted e = examined(timeline, run.measured, rounded);
  EXPECT_EQ(strongest_periodic_input(e.problem, *e.projector).equation, Equation::accelerometer);
  rounded.accelerometers_rounded = true;
  const search::Fitted none = examined(timeline, run.measured, rounded);
  EXPECT_EQ(strongest_periodic_input(none.problem, *none.projector).p_value(), 1.0);
}

}  // namespace
}  // namespace drift::inference::periodic_input_test
