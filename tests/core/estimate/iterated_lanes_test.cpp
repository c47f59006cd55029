#include "core/estimate/sequential/in_lanes/iterated_lanes.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/estimate/sequential/iterated_passes.hpp"
#include "core/sim/simulate.hpp"
#include "tests/support/estimators.hpp"
#include "tests/support/model_builders.hpp"

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
      ASSERT_EQ(jobs[k].status(), one.status()) << jobs[k].cause();
      EXPECT_EQ(jobs[k].scalars(), one.scalars());
      // Paths of two rules of the fourth order: in slews they differ by 1e-4 of the noise.
      EXPECT_NEAR(jobs[k].nis() / one.nis(), 1.0, 1e-5);
      EXPECT_NEAR(jobs[k].lag1(), one.lag1(), 1e-5);
      const VecX sigma = one.settled_covariance().diagonal().cwiseSqrt();
      EXPECT_LT((jobs[k].x() - one.x()).cwiseQuotient(sigma).cwiseAbs().maxCoeff(), 1e-3)
          << c.preset << k;
      for (std::size_t s = 0; s < one.layout().size(); ++s)
        EXPECT_NEAR(jobs[k].sigma(s) / one.sigma(s), 1.0, 1e-6);
    }
  }
}

TEST(IteratedLanes, AJobDoesNotDependOnTheOthers) {
  const Timeline timeline = preset_timeline("slew12", CommandLaw::free, 3600.0, 600.0);
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
