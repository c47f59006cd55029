// A filter with an effect that the truth does not have: its size is 0 there, its setting has no
// value.
#include "core/sim/judged_truth.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mc/statistics/point_statistics.hpp"
#include "mc/task/trace.hpp"
#include "tests/mc/small_study.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::judged_truth_test {
namespace {

using namespace drift::test;
using C = mc::StudyColumns;

constexpr std::size_t runs = 40;

/// The small study, whose right filter has a warm-up drift beyond the truth and estimates its time
/// constant, known to 2 min.
mc::Study with_warmup(const std::string& estimator) {
  return read_text(small_study,
                   {{"filter.right.terms+", "warmup_drift"},
                    {"filter.right.starts", "1"},
                    {"filter.right.parameters.W_tau", "{ normal = [\"40 min\", \"2 min\"] }"},
                    {"monte_carlo.estimator", estimator}});
}

TEST(JudgedTruth, HasNoSettingOfAnEffectThatIsNotThere) {
  TruthSpec truth = with_warmup("ekf").truth;
  const Theta drawn = Theta::Constant(3.0);
  const Theta without = judged_truth(truth, drawn);
  EXPECT_TRUE(std::isnan(without[param("W_tau")]));
  EXPECT_TRUE(std::isnan(without[param("dD_t0")])) << "when something sets in";
  EXPECT_TRUE(std::isnan(without[param("enc_n")])) << "a number of a few";
  EXPECT_EQ(without[param("W_x")], 3.0) << "a size is a number";
  truth.active |= TermLibrary::completed(params_named("warmup_drift"));
  EXPECT_EQ(judged_truth(truth, drawn)[param("W_tau")], 3.0);
}

/// Truth and filter agree but for what harms nothing, so NEES of what the truth has a value for is
/// that of an honest filter: its mean is within 4 standard deviations sqrt(2 / dof) of 1. (With a
/// time constant of 0, 20 prior sigmas off, it was 23.)
TEST(JudgedTruth, OfWhatItDoesNotHaveNoEstimateIsWrong) {
  for (const char* estimator : {"ekf", "iterated", "batch"}) {
    const mc::StudyTask task(with_warmup(estimator));
    const auto worker = task.worker();
    const mc::Block block = run_block(task, *worker, 0, runs);
    const C::Filter& columns = task.layout().filters[0];
    const auto& params = columns.layout.params;
    const auto tau =
        static_cast<std::size_t>(std::ranges::find(params, param("W_tau")) - params.begin());
    ASSERT_LT(tau, params.size());
    EXPECT_TRUE(std::isnan(block.rows[columns.truth[tau]])) << estimator;
    EXPECT_TRUE(std::isfinite(block.rows[columns.estimate(0, tau)])) << estimator;
    mc::PointStatistics statistics(task.study());
    statistics.add(block);
    const mc::FilterStatistics& filter = statistics.filters()[0];
    const mc::StartStatistics& s = filter.starts()[0];
    EXPECT_EQ(statistics.failures().lost().hits, 0u) << estimator;
    EXPECT_EQ(filter.errors()[tau].runs(), 0u) << estimator;
    EXPECT_EQ(filter.errors()[0].runs(), runs) << estimator;
    EXPECT_EQ(filter.health()[tau].wrong.hits, 0u) << estimator;
    EXPECT_EQ(s.nees_all.dof, static_cast<double>(runs * (params.size() - 1))) << estimator;
    EXPECT_LE(s.nees.dof, s.nees_all.dof) << estimator;
    if (estimator == std::string_view("ekf")) continue;  // linearises once: NEES 2 and more
    EXPECT_NEAR(s.nees_all.mean(), 1.0, 4.0 * std::sqrt(2.0 / s.nees_all.dof)) << estimator;
    EXPECT_EQ(s.wrong.hits, 0u) << estimator;
  }
}

TEST(JudgedTruth, IsWhatATraceIsComparedWith) {
  const mc::RunTrace trace = mc::trace_run(with_warmup("ekf"), 3);
  EXPECT_TRUE(std::isnan(trace.truth[param("W_tau")]));
  EXPECT_EQ(trace.truth[param("W_x")], 0.0);
  EXPECT_NE(trace.truth[param("D_F_x")], 0.0);
}

}  // namespace
}  // namespace drift::judged_truth_test
