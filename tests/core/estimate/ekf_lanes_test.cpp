#include "core/estimate/sequential/in_lanes/ekf_lanes.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

#include "core/sim/simulate.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::ekf_lanes_test {
namespace {

using namespace drift::test;

/// Recordings of several runs; some have gaps.
std::vector<Measurements> recordings(const Timeline& timeline, const TruthSpec& truth,
                                     std::size_t count) {
  std::vector<Measurements> all;
  Simulator simulator(truth, Readout{});
  for (std::uint64_t run = 0; run < count; ++run)
    all.push_back(simulator.run(timeline, 4, run).measured);
  const double missing = std::numeric_limits<double>::quiet_NaN();
  if (count > 1) all[1].acc.col(2).setConstant(missing);
  if (count > 1) all[1].gimbal(1, 3) = missing;
  if (count > 2) all[2].gimbal.setConstant(missing);
  return all;
}

std::vector<EkfJob> jobs_of(const std::vector<Measurements>& all, const Theta& start) {
  std::vector<EkfJob> jobs(all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    jobs[k].measured = &all[k];
    jobs[k].start = start;
  }
  return jobs;
}

struct Case {
  const char* preset;
  CommandLaw mode;
  Coupling truth, filter;
};

// The same algorithm in another order of operations: what remains is rounding, 1e-16 times the
// condition of the covariances, at most 1e8.
TEST(EkfLanes, AgreeWithTheFilterOfOneRunToRounding) {
  for (const Case& c : {Case{"six", CommandLaw::free, Coupling::eq5, Coupling::eq5},
                        {"six", CommandLaw::free, Coupling::eq5, Coupling::eq6},
                        {"slew12", CommandLaw::free, Coupling::eq6, Coupling::eq6},
                        {"six", CommandLaw::level, Coupling::compensated, Coupling::compensated}}) {
    const Timeline timeline = preset_timeline(c.preset, c.mode, 3600.0, 300.0);
    const FilterSpec filter = base_filter(c.filter);
    ASSERT_TRUE(LaneIntervals::can(filter, timeline));
    const Theta start = make_layout(filter).theta;
    const auto all = recordings(timeline, base_truth(c.truth), 3);
    auto jobs = jobs_of(all, start);
    EkfLanes(filter, timeline, Readout{}).run(jobs);
    for (std::size_t k = 0; k < jobs.size(); ++k) {
      Ekf one(filter, timeline, Readout{}, start, KeepHistory::no);
      for (std::size_t i = 0; i < timeline.intervals.size(); ++i) {
        const auto at = static_cast<Eigen::Index>(i);
        one.process(i, all[k].acc.col(at), all[k].gimbal.col(at));
      }
      ASSERT_EQ(jobs[k].status(), one.status()) << jobs[k].cause();
      EXPECT_EQ(jobs[k].scalars(), one.scalars());
      EXPECT_NEAR(jobs[k].nis() / one.nis(), 1.0, 1e-7);
      EXPECT_NEAR(jobs[k].lag1(), one.lag1(), 1e-7);
      for (std::size_t s = 0; s < make_layout(filter).size(); ++s) {
        const auto at = static_cast<Eigen::Index>(s);
        EXPECT_NEAR(jobs[k].sigma(s) / one.sigma(s), 1.0, 1e-7) << c.preset << k;
        EXPECT_NEAR(jobs[k].x()[at], one.x()[at],
                    1e-6 * std::sqrt(jobs[k].settled_covariance()(at, at)))
            << c.preset << k;
      }
    }
  }
}

TEST(EkfLanes, AJobDoesNotDependOnTheOthers) {
  const Timeline timeline = preset_timeline("slew12", CommandLaw::free, 3600.0, 600.0);
  const FilterSpec filter = base_filter(Coupling::eq5);
  const Theta start = make_layout(filter).theta;
  const auto all = recordings(timeline, base_truth(Coupling::eq6), 11);
  auto together = jobs_of(all, start);
  EkfLanes lanes(filter, timeline, Readout{});
  std::vector<EkfHistory> histories(together.size());
  lanes.run(together, histories);
  for (const std::size_t k : {std::size_t{10}, std::size_t{2}, std::size_t{1}}) {
    auto alone = jobs_of({all[k]}, start);
    alone[0].measured = &all[k];
    lanes.run(alone);
    const EkfHistory& history = histories[k];
    EXPECT_EQ(alone[0].x(), together[k].x()) << k;
    EXPECT_EQ(alone[0].settled_covariance(), together[k].settled_covariance());
    EXPECT_EQ(alone[0].nis(), together[k].nis());
    EXPECT_EQ(alone[0].lag1(), together[k].lag1());
    const Eigen::Index last = history.estimate.cols() - 1;
    for (Eigen::Index s = 0; s < history.estimate.rows(); ++s)
      EXPECT_EQ(history.sigma(s, last), alone[0].sigma(static_cast<std::size_t>(s)));
    EXPECT_NEAR(std::accumulate(history.nis.begin(), history.nis.end(), 0.0), alone[0].nis(),
                1e-12 * alone[0].nis());
  }
}

TEST(EkfLanes, OneThatDivergesLeavesTheOthersAlone) {
  const Timeline timeline = preset_timeline("six", CommandLaw::free, 3600.0, 600.0);
  const FilterSpec filter = base_filter(Coupling::eq5);
  const Theta start = make_layout(filter).theta;
  auto all = recordings(timeline, base_truth(Coupling::eq5), 2);
  EkfLanes lanes(filter, timeline, Readout{});
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
}  // namespace drift::ekf_lanes_test
