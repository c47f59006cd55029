// Recordings of one unit after each other: nothing but the parameters goes from one to the next.
#include <gtest/gtest.h>

#include "core/estimate/compressed/compressed_dwells.hpp"
#include "core/estimate/sequential/interval_rows.hpp"
#include "tests/support/estimators.hpp"
#include "tests/support/pulls.hpp"
#include "tests/support/term_scenes.hpp"
#include "tests/support/two_recordings.hpp"

namespace drift::joined_timeline_test {
namespace {

using namespace drift::test;

TEST(JoinedTimeline, HasTheClockOfEachRecordingHoweverItIsMade) {
  const Timeline once = preset_timeline("six", CommandLaw::free), both = twice(once);
  const CompressedTest compressed(both, {}, {});
  ASSERT_TRUE(compressed.any());
  const double begin = once.intervals.back().t1;
  for (const Timeline* t : {&both, &compressed.timeline()}) {
    EXPECT_EQ(t->intervals.front().t_begin, 0.0);
    EXPECT_EQ(t->intervals.back().t_begin, begin);
    for (const Interval& i : t->intervals) {
      EXPECT_EQ(i.begins, i.t0 == 0.0 || i.t0 == begin) << i.t0;
    }
  }
}

/// As far apart as sums of times are that begin elsewhere.
void expect_same(const MemoryPoint& a, const MemoryPoint& b) {
  for (std::size_t k = 0; k < num_memory; ++k) {
    EXPECT_NEAR(a.value[k], b.value[k], 1e-9 * std::max(1.0, std::abs(b.value[k])));
    EXPECT_NEAR(a.derivative[k], b.derivative[k], 1e-9 * std::max(1.0, std::abs(b.derivative[k])));
  }
}

TEST(JoinedTimeline, CarriesNoMemoryFromOneRecordingToTheNext) {
  const Timeline once = scene("slew12", CommandLaw::level), both = twice(once);
  const std::size_t n = once.intervals.size();
  std::size_t terms = 0;
  for (const std::size_t t : visible_terms()) {
    if (TermLibrary::terms[t].memory == 0) continue;
    SCOPED_TRACE(TermLibrary::terms[t].key);
    ++terms;
    FilterSpec filter = base_filter(Coupling::eq6);
    filter.active = only({"D_F"}) | term_params(t);
    const DriftModel model = filter.model();
    Theta theta = make_layout(filter).theta;
    set_term(theta, t);
    MemoryPath alone(once, model), joined(both, model);
    for (std::size_t i = 0; i < n; ++i) joined.advance(i, theta.data());
    for (std::size_t i = 0; i < n; ++i) {
      alone.advance(i, theta.data());
      joined.advance(n + i, theta.data());
      for (std::size_t k = 0; k + 1 < 2 * once.intervals[i].node_count(); ++k)
        expect_same(joined.points()[k], alone.points()[k]);
    }
    // What is predicted, and by whoever jumps about in the timeline, follows.
    const std::vector<Vec3> psi(static_cast<std::size_t>(both.chains), Vec3(4e-4, -3e-4, 5e-4));
    const Measurements p = predict(both, model, theta, psi, Readout{});
    const auto count = static_cast<Eigen::Index>(n);
    const Measurements first{p.acc.leftCols(count), p.gimbal.leftCols(count)},
        second{p.acc.rightCols(count), p.gimbal.rightCols(count)};
    EXPECT_LT(difference(first, second), 1e-11);
    MemoryRecord record(both, model);
    record.trace(theta.data());
    expect_same(record.points(both.intervals[n])[0], record.points(both.intervals[0])[0]);
  }
  EXPECT_GE(terms, 4u);
}

/// Every estimator on two recordings of one unit.
TEST(JoinedTimeline, ShowsEveryEstimatorATermWithMemory) {
  const Timeline once = preset_timeline("six", CommandLaw::free, 720.0), both = twice(once);
  TruthSpec truth = base_truth(Coupling::eq5);
  truth.active = only({"D_F", "D_I", "D_O", "D_S"}) | params_named("reposition_transient");
  FilterSpec filter = base_filter(Coupling::eq5);
  filter.active = truth.active;
  TruthDraw draw = draw_truth(truth, once.chains, 3, 0);
  for (const char* key : {"R_x", "R_y", "R_z"}) draw.theta[param(key)] = 0.1 * deg_per_h;
  std::vector<Measurements> parts;
  for (const std::uint64_t run : {0u, 1u}) {
    const Simulation sim = Simulator(truth, Readout{}).run(once, draw, 3, run);
    ASSERT_TRUE(sim.ode.ok());
    parts.push_back(sim.measured);
  }
  const Measurements measured = one_after_the_other(parts[0], parts[1]);
  const Theta start = make_layout(filter).theta;
  for (const Estimator& estimator : every_estimator) {
    SCOPED_TRACE(estimator.name);
    const EstimateResult r = estimator.run(filter, both, Readout{}, measured, start);
    EXPECT_EQ(r.status, EstimateStatus::ok) << r.cause;
    // Of 864 scalars: five of (2/m)^0.5.
    EXPECT_NEAR(r.statistic_per_dof(), 1.0, 5.0 * std::sqrt(2.0 / static_cast<double>(r.measured)));
    for (const char* key : {"R_x", "R_y", "R_z"}) {
      const ParameterEstimate& p = *r.find(param(key));
      EXPECT_LT(p.sigma, 0.05 * deg_per_h) << key;
      EXPECT_LT(std::abs(p.value - 0.1 * deg_per_h), 5.0 * p.sigma) << key;
    }
  }
}

/// Drift, its g-dependence and noise of all kinds that a filter knows.
FilterSpec walking_filter(double q) {
  FilterSpec filter = base_filter(Coupling::eq5);
  filter.active = only({"D_F", "D_I"}) | params_named("drift_random_walk");
  for (const char* key : {"q_x", "q_y", "q_z"}) filter.priors[param(key)] = fixed(q);
  return filter;
}

/// The whitened rows of a timeline about the nominal path.
std::vector<double> rows_of(const FilterSpec& filter, const Timeline& timeline,
                            const Measurements& measured) {
  const Theta theta = make_layout(filter).theta;
  const Trajectory path =
      integrate_fixed(timeline, filter.model(), theta,
                      std::vector<Vec3>(static_cast<std::size_t>(timeline.chains), Vec3::Zero()));
  IntervalRows pass(filter, timeline, Readout{});
  pass.reset(theta);
  std::vector<double> rows(3 * pass.most_triples() * pass.width());
  std::size_t triples = 0;
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i) {
    const Interval& interval = timeline.intervals[i];
    pass.enter(i);
    pass.look_ahead(i, i + 1, path.data());
    if (interval.cage) pass.cage(interval, path[interval.first_node]);
    const auto column = static_cast<Eigen::Index>(i);
    const auto taken = pass.take(i, measured.acc.col(column), measured.gimbal.col(column),
                                 path.data(), nullptr, rows.data() + 3 * triples * pass.width());
    EXPECT_TRUE(taken.ok);
    triples += taken.triples;
  }
  rows.resize(3 * triples * pass.width());
  return rows;
}

TEST(JoinedTimeline, RowsOfADriftThatWalksAreThoseOfEachRecordingAlone) {
  const Timeline once = preset_timeline("six", CommandLaw::level, 1200.0, 120.0);
  FilterSpec filter = walking_filter(0.05 * deg_per_h / 60.0);
  filter.noise.angle_random_walk = 1e-3 * detail::deg / 60.0;
  TruthSpec truth = base_truth(Coupling::eq5);
  truth.active = only({"D_F", "D_I"});
  const Simulation sim = Simulator(truth, Readout{}).run(once, 4, 0);
  ASSERT_TRUE(sim.ode.ok());
  const std::vector<double> alone = rows_of(filter, once, sim.measured);
  const std::vector<double> both =
      rows_of(filter, twice(once), one_after_the_other(sim.measured, sim.measured));
  ASSERT_EQ(both.size(), 2 * alone.size());
  double largest = 0.0;
  for (const double v : alone) largest = std::max(largest, std::abs(v));
  for (std::size_t k = 0; k < alone.size(); ++k) {
    EXPECT_EQ(both[k], alone[k]);
    EXPECT_NEAR(both[alone.size() + k], alone[k], 1e-9 * largest);
  }
}

/// The covariance of everything, and rows over what stands still: two ways of one model. What they
/// do not share are the points that they linearise about.
TEST(JoinedTimeline, BothSequentialEstimatorsLetADriftBeginAnewAlike) {
  const Timeline once = preset_timeline("six", CommandLaw::level, 1200.0, 120.0),
                 both = twice(once);
  FilterSpec filter = walking_filter(0.1 * deg_per_h / 60.0);
  filter.active |= params_named("bistable_drift");
  for (const char* key : {"B_x", "B_y", "B_z"}) filter.priors[param(key)] = fixed(0.1 * deg_per_h);
  TruthSpec truth = base_truth(Coupling::eq5);
  static_cast<ModelSpec&>(truth) = filter;
  const Theta theta = draw_parameters(truth, 6, 0, Purpose::parameters);
  std::vector<Measurements> parts;
  for (const std::uint64_t run : {0u, 1u}) {
    TruthDraw draw = draw_truth(truth, once.chains, 6, run);
    draw.theta = theta;
    parts.push_back(Simulator(truth, Readout{}).run(once, draw, 6, run).measured);
  }
  const Measurements measured = one_after_the_other(parts[0], parts[1]);
  const Theta start = make_layout(filter).theta;
  const EstimateResult ekf = by_ekf(filter, both, Readout{}, measured, start),
                       iterated = by_iterated_ekf(filter, both, Readout{}, measured, start);
  ASSERT_EQ(ekf.status, EstimateStatus::ok) << ekf.cause;
  ASSERT_EQ(iterated.status, EstimateStatus::ok) << iterated.cause;
  ASSERT_EQ(ekf.covariance.rows(), iterated.covariance.rows());
  for (std::size_t k = 0; k < ekf.parameters.size(); ++k) {
    const ParameterEstimate &a = ekf.parameters[k], &b = iterated.parameters[k];
    EXPECT_LT(std::abs(a.value - b.value), 0.1 * b.sigma) << TermLibrary::specs[a.param].key.view();
    EXPECT_NEAR(a.sigma / b.sigma, 1.0, 0.02) << TermLibrary::specs[a.param].key.view();
  }
}

TEST(JoinedTimeline, LeavesErrorsAsLargeAsTheirSigmasWhereADriftWalks) {
  const Timeline once = preset_timeline("six", CommandLaw::level, 1800.0, 120.0),
                 both = twice(once);
  const FilterSpec filter = walking_filter(0.5 * deg_per_h / 60.0);
  TruthSpec truth = base_truth(Coupling::eq5);
  static_cast<ModelSpec&>(truth) = filter;
  const Theta start = make_layout(filter).theta;
  constexpr std::uint64_t units = 10;
  Pulls pulls;
  for (std::uint64_t unit = 0; unit < units; ++unit) {
    Theta theta = draw_parameters(truth, 7, unit, Purpose::parameters);
    std::vector<Measurements> parts;
    for (const std::uint64_t run : {2 * unit, 2 * unit + 1}) {
      TruthDraw draw = draw_truth(truth, once.chains, 7, run);
      draw.theta = theta;
      const Simulation sim = Simulator(truth, Readout{}).run(once, draw, 7, run);
      ASSERT_TRUE(sim.ode.ok());
      parts.push_back(sim.measured);
      if (run % 2 == 1) theta = sim.theta_end;  // what an estimate at the end is of
    }
    const EstimateResult r =
        by_ekf(filter, both, Readout{}, one_after_the_other(parts[0], parts[1]), start);
    ASSERT_EQ(r.status, EstimateStatus::ok) << r.cause;
    pulls.add(r, theta);
  }
  expect_as_large_as_sigmas(pulls);
}

TEST(JoinedTimeline, ASimulatedDriftBeginsEachRecordingAtTheSameValue) {
  const Timeline once = preset_timeline("six", CommandLaw::level, 120.0, 60.0), both = twice(once);
  const double q = 0.5 * deg_per_h / 60.0;
  TruthSpec truth = base_truth(Coupling::eq5);
  static_cast<ModelSpec&>(truth) = walking_filter(q);
  Simulator simulator(truth, Readout{});
  double squares = 0.0;
  constexpr int runs = 200;
  for (std::uint64_t run = 0; run < runs; ++run) {
    const Simulation sim = simulator.run(both, 8, run);
    ASSERT_TRUE(sim.ode.ok());
    for (const char* key : {"D_F_x", "D_F_y", "D_F_z"}) {
      const double walked = sim.theta_end[param(key)] - sim.draw.theta[param(key)];
      squares += walked * walked;
    }
  }
  const double variance = q * q * (once.intervals.back().t1 - once.intervals.front().t0);
  // A mean of 600 squares: five sigma. Had it gone on it would be twice as large.
  EXPECT_NEAR(squares / (3.0 * runs * variance), 1.0, 5.0 * std::sqrt(2.0 / (3.0 * runs)));
}

}  // namespace
}  // namespace drift::joined_timeline_test
