#include "core/estimate/sequential/in_lanes/iterated_lanes.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <tuple>

#include "core/estimate/sequential/iterated_passes.hpp"
#include "core/sim/simulate.hpp"
#include "tests/support/estimators.hpp"
#include "tests/support/model_builders.hpp"
#include "tests/support/term_scenes.hpp"

namespace drift::iterated_lanes_test {
namespace {

using namespace drift::test;

/// Recordings of several runs; some have gaps.
std::vector<Measurements> recordings(const Timeline& timeline, const TruthSpec& truth,
                                     std::size_t count) {
  std::vector<Measurements> all;
  Simulator simulator(truth, Readout{});
  for (std::uint64_t run = 0; run < count; ++run) {
    const Simulation sim = simulator.run(timeline, 4, run);
    EXPECT_TRUE(sim.ode.ok());
    all.push_back(sim.measured);
  }
  const double missing = std::numeric_limits<double>::quiet_NaN();
  if (count > 1) all[1].acc.col(2).setConstant(missing);
  if (count > 1) all[1].gimbal(1, 3) = missing;
  if (count > 2) all[2].gimbal.setConstant(missing);
  return all;
}

std::vector<IteratedJob> jobs_of(const std::vector<Measurements>& all, const Theta& start) {
  std::vector<IteratedJob> jobs(all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    jobs[k].measured = &all[k];
    jobs[k].start = start;
  }
  return jobs;
}

struct Case {
  const char* preset;
  CommandLaw mode;
  Coupling coupling;
};

/// Estimates apart in sigmas of the posterior, and sigmas in relation.
struct Apart {
  double estimate, sigma;
};
void expect_alike(const IteratedJob& job, const IteratedPasses& one, const Apart& most) {
  ASSERT_EQ(job.status(), one.status()) << job.cause();
  EXPECT_EQ(job.scalars(), one.scalars());
  // Paths of two rules of the fourth order: in slews they differ by 1e-4 of the noise.
  EXPECT_NEAR(job.nis() / one.nis(), 1.0, 1e-5);
  const VecX sigma = one.settled_covariance().diagonal().cwiseSqrt();
  EXPECT_LT((job.x() - one.x()).cwiseQuotient(sigma).cwiseAbs().maxCoeff(), most.estimate);
  for (std::size_t s = 0; s < one.layout().size(); ++s)
    EXPECT_NEAR(job.sigma(s) / one.sigma(s), 1.0, most.sigma);
}

TEST(IteratedLanes, AgreeWithTheEstimatorOfOneRun) {
  for (const Case& c : {Case{"six", CommandLaw::free, Coupling::eq5},
                        {"six", CommandLaw::free, Coupling::eq6},
                        {"slew12", CommandLaw::free, Coupling::eq6},
                        {"six", CommandLaw::level, Coupling::compensated}}) {
    const Timeline timeline = preset_timeline(c.preset, c.mode, 3600.0, 300.0);
    const FilterSpec filter = base_filter(c.coupling);
    ASSERT_TRUE(LaneIntervals::can(filter, timeline));
    const Theta start = make_layout(filter).theta;
    const auto all = recordings(timeline, base_truth(c.coupling), 3);
    auto jobs = jobs_of(all, start);
    IteratedLanes(filter, timeline, Readout{}).run(jobs);
    IteratedPasses one(filter, timeline, Readout{}, start);
    for (std::size_t k = 0; k < jobs.size(); ++k) {
      one.run(all[k], start);
      SCOPED_TRACE(c.preset);
      expect_alike(jobs[k], one, {1e-3, 1e-6});
      EXPECT_NEAR(jobs[k].lag1(), one.lag1(), 1e-5);
    }
  }
}

/// Terms that see the clock, the attitude or covariates, too: all lanes see the same.
TEST(IteratedLanes, WithEveryTermTheyCanAgreeWithTheEstimatorOfOneRun) {
  int terms = 0;
  for (std::size_t t = 0; t < TermLibrary::num_known; ++t) {
    const std::string name(TermLibrary::terms[t].key);
    SCOPED_TRACE(name);
    FilterSpec filter = base_filter(Coupling::eq5);
    filter.active |= term_params(t);
    const Timeline timeline = scene("slew12", CommandLaw::free, 600.0, 60.0);
    if (!LaneIntervals::can(filter, timeline) || all_in_lanes(filter.model().terms)) continue;
    ++terms;
    TruthSpec truth;
    static_cast<ModelSpec&>(truth) = filter;
    const Theta start = make_layout(filter).theta;
    Simulator simulator(truth, Readout{});
    std::vector<Measurements> all;
    for (std::uint64_t run = 0; run < 2; ++run)
      all.push_back(simulator.run(timeline, 4, run).measured);
    auto jobs = jobs_of(all, start);
    IteratedLanes(filter, timeline, Readout{}).run(jobs);
    IteratedPasses one(filter, timeline, Readout{}, start);
    for (std::size_t k = 0; k < jobs.size(); ++k) {
      one.run(all[k], start);
      expect_alike(jobs[k], one, {2e-3, 1e-5});
    }
  }
  EXPECT_GE(terms, 15);
}

/// Stretches through polynomials against every sample: a tail that StretchRows::negligible lets
/// through changes a sigma by less than a ten thousandth.
TEST(IteratedLanes, ThroughPolynomialsIsSampleBySample) {
  for (const auto& [preset, truth, coupling] : {std::tuple("six", Coupling::eq5, Coupling::eq5),
                                                {"six", Coupling::eq5, Coupling::eq6},
                                                {"slew12", Coupling::eq6, Coupling::eq6},
                                                {"slew12", Coupling::eq5, Coupling::eq6},
                                                {"casespin", Coupling::eq5, Coupling::lambda}}) {
    SCOPED_TRACE(preset);
    const Timeline timeline = preset_timeline(preset, CommandLaw::free, 3600.0, 60.0);
    FilterSpec filter = base_filter(coupling);
    if (coupling == Coupling::lambda) filter.active.set(closure_param);
    const Layout layout = make_layout(filter);
    const auto all = recordings(timeline, base_truth(truth), 3);
    auto jobs = jobs_of(all, layout.theta);
    IteratedLanes lanes(filter, timeline, Readout{});
    ASSERT_TRUE(lanes.compressed());
    lanes.run(jobs);
    IteratedPasses one(filter, timeline, Readout{}, layout.theta);
    for (std::size_t k = 0; k < jobs.size(); ++k) {
      one.run(all[k], layout.theta);
      // Both stop less than a sigma before the minimum.
      expect_alike(jobs[k], one, {1e-3, 2e-4});
      // Of samples, and of innovations: the same expectation, not the same number.
      EXPECT_NEAR(jobs[k].lag1(), one.lag1(),
                  0.1 * std::abs(one.lag1()) + 0.5 / std::sqrt(static_cast<double>(one.scalars())));
    }
  }
}

/// Second implementation: all samples, attitudes and parameters in one matrix. Neighbours' products
/// of residuals r_k r_l, less -J_k P J_l^T.
TEST(IteratedLanes, LagOfStretchesIsThatOfAllTheirSamples) {
  const Timeline timeline = preset_timeline("six", CommandLaw::free, 1800.0, 30.0);
  const FilterSpec filter = base_filter(Coupling::eq6);
  const Layout layout = make_layout(filter);
  const Readout readout;
  const Measurements measured = recordings(timeline, base_truth(Coupling::eq5), 1)[0];
  std::vector<IteratedJob> job(1);
  job[0].measured = &measured;
  job[0].start = layout.theta;
  IteratedLanes lanes(filter, timeline, readout);
  ASSERT_TRUE(lanes.compressed());
  lanes.run(job);
  const MeasuredTest test{timeline, readout, measured};
  const BatchResult fit = fit_batch(filter, test, layout.theta);
  const Theta theta = theta_of(filter, fit);
  Trajectory phi;
  predict(timeline, filter.model(), theta, fit.psi0_l, readout, &phi);
  const auto chains =
      measurement_equations(test, filter.model(), layout, theta, phi, filter.initial_attitude);
  const auto n = static_cast<Eigen::Index>(layout.size()),
             attitudes = 3 * static_cast<Eigen::Index>(chains.size());
  const auto full = [&](std::size_t c) {
    const MatX& rows = chains[c].rows;
    MatX J = MatX::Zero(rows.rows(), attitudes + n);
    J.middleCols(3 * static_cast<Eigen::Index>(c), 3) = rows.leftCols(3);
    J.rightCols(n) = rows.middleCols(3, n);
    return J;
  };
  MatX information = MatX::Identity(attitudes + n, attitudes + n);
  for (std::size_t c = 0; c < chains.size(); ++c) information += full(c).transpose() * full(c);
  const MatX P = information.inverse();
  double lagged = 0.0, cost = 0.0;
  int pairs = 0;
  for (std::size_t c = 0; c < chains.size(); ++c) {
    const MatX J = full(c), PJt = P * J.transpose();
    const VecX r = chains[c].rows.rightCols(1);
    cost += r.squaredNorm();
    for (Eigen::Index k = 0; k + 6 < r.size(); ++k, ++pairs)  // of a sample six
      lagged += r[k] * r[k + 6] + J.row(k).dot(PJt.col(k + 6));
  }
  const double variance = fit.estimate.statistic / static_cast<double>(job[0].scalars());
  EXPECT_LT(cost, fit.estimate.statistic);
  EXPECT_NEAR(job[0].lag1(), lagged / pairs / variance, 1e-5);
}

/// What is missing in a stretch is seen sample by sample, to the last bit.
TEST(IteratedLanes, AGapInAStretchIsSeenSampleBySample) {
  const Timeline timeline = preset_timeline("six", CommandLaw::free, 1800.0, 30.0);
  const FilterSpec filter = base_filter(Coupling::eq5);
  const Theta start = make_layout(filter).theta;
  const auto all = recordings(timeline, base_truth(Coupling::eq5), 3);  // the last two have gaps
  auto jobs = jobs_of(all, start), alone = jobs_of({all[2]}, start);
  alone[0].measured = &all[2];
  IteratedLanes lanes(filter, timeline, Readout{});
  lanes.run(jobs);
  lanes.run(alone);
  IteratedPasses one(filter, timeline, Readout{}, start);
  one.run(all[2], start);
  EXPECT_EQ(jobs[2].x(), alone[0].x());
  EXPECT_EQ(jobs[2].lag1(), alone[0].lag1());
  EXPECT_EQ(jobs[2].scalars(), one.scalars());
  EXPECT_NEAR(jobs[2].lag1(), one.lag1(), 1e-5);
}

TEST(IteratedLanes, AJobDoesNotDependOnTheOthers) {
  const Timeline timeline = preset_timeline("slew12", CommandLaw::free, 3600.0, 60.0);
  const FilterSpec filter = base_filter(Coupling::eq5);
  const Theta start = make_layout(filter).theta;
  const auto all = recordings(timeline, base_truth(Coupling::eq6), 11);
  auto together = jobs_of(all, start);
  IteratedLanes lanes(filter, timeline, Readout{});
  lanes.run(together);
  for (const std::size_t k : {std::size_t{10}, std::size_t{2}, std::size_t{1}}) {
    auto alone = jobs_of({all[k]}, start);
    alone[0].measured = &all[k];
    lanes.run(alone);
    EXPECT_EQ(alone[0].x(), together[k].x()) << k;
    EXPECT_EQ(alone[0].settled_covariance(), together[k].settled_covariance());
    EXPECT_EQ(alone[0].nis(), together[k].nis());
    EXPECT_EQ(alone[0].lag1(), together[k].lag1());
  }
}

TEST(IteratedLanes, OneThatDivergesLeavesTheOthersAlone) {
  const Timeline timeline = preset_timeline("six", CommandLaw::free, 3600.0, 600.0);
  const FilterSpec filter = base_filter(Coupling::eq5);
  const Theta start = make_layout(filter).theta;
  auto all = recordings(timeline, base_truth(Coupling::eq5), 2);
  IteratedLanes lanes(filter, timeline, Readout{});
  auto alone = jobs_of({all[0]}, start);
  alone[0].measured = &all[0];
  lanes.run(alone);
  all[1].acc.col(4).setConstant(1e15);
  auto both = jobs_of(all, start);
  lanes.run(both);
  EXPECT_EQ(both[0].status(), EstimateStatus::ok);
  EXPECT_EQ(both[0].x(), alone[0].x());
  EXPECT_EQ(both[1].status(), EstimateStatus::diverged);
  EXPECT_GT(both[1].t_diverged(), 0.0);
  EXPECT_NE(both[1].cause().find("diverged at t ="), std::string::npos);
}

}  // namespace
}  // namespace drift::iterated_lanes_test
