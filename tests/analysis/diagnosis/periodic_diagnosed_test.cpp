// Something periodic that no term describes: found, located and said with its period.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::diagnosis::periodic_diagnosed_test {
namespace {

using namespace drift::test;

TEST(Diagnose, AResolverErrorThatComesBackIsUnexplainedAndSaidToSwing) {
  const Timeline timeline = preset_timeline("twelve", CommandLaw::free, 1800.0, 90.0);
  const Readout readout;
  Measurements measured =
      Simulator(base_truth(Coupling::eq5), readout).run(timeline, 12, 0).measured;
  // A sawtooth has a twelfth of its square as variance, of which a sinusoid holds 6 / pi^2.
  constexpr double period = 23.7 * 60.0, sigmas = 15.0;
  const auto rows = static_cast<double>(timeline.intervals.size());
  const double height = readout.gimbal_noise * sigmas * std::sqrt(12.0 / rows);
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i) {
    const double cycles = timeline.intervals[i].t1 / period;
    measured.gimbal(0, static_cast<Eigen::Index>(i)) +=
        height * (cycles - std::floor(cycles) - 0.5);
  }
  const Diagnosis d =
      diagnose(base_filter(Coupling::eq5), {timeline, readout, measured}, {}, {}, {});
  EXPECT_EQ(d.verdict, Verdict::unexplained) << report::sentence(d);
  EXPECT_EQ(d.where.equation, "gimbal outer");
  ASSERT_FALSE(d.signals.empty());
  EXPECT_EQ(d.signals[0].equation, "gimbal outer");
  EXPECT_EQ(d.signals[0].shape.kind, Shape::Kind::period);
  const auto told = std::ranges::find_if(
      d.remarks, [](const Remark& r) { return std::holds_alternative<remark::PeriodExplains>(r); });
  ASSERT_NE(told, d.remarks.end());
  const auto& r = std::get<remark::PeriodExplains>(*told);
  EXPECT_EQ(r.equation, "gimbal outer");
  EXPECT_EQ(r.unit, "arcsec");
  // The sigma of a frequency, in cycles over the test, and the grid it is looked for on.
  const double z = sigmas * std::sqrt(6.0) / std::numbers::pi, span = timeline.intervals.back().t1,
               cycles = 4.0 * std::sqrt(3.0) / (std::numbers::pi * z) + 1.0 / 16.0;
  EXPECT_LT(std::abs(span / r.period_s - span / period), cycles);
  EXPECT_NEAR(r.amplitude * arcsec, height / std::numbers::pi, 4.0 * height / std::numbers::pi / z);
}

TEST(Diagnose, ACauseKeepsItsNameBesideSomethingThatComesBack) {
  const Timeline timeline = preset_timeline("twelve", CommandLaw::free, 1200.0);
  TruthSpec truth = base_truth(Coupling::eq5);
  truth.active |= params_named("warmup_drift");
  TruthDraw draw = draw_truth(truth, timeline.chains, 3, 1);
  for (const char* key : {"W_y", "W_z"}) draw.theta[param(key)] = 0.0;
  draw.theta[param("W_x")] = 0.4 * deg_per_h;
  draw.theta[param("W_tau")] = 3600.0;
  const Readout readout;
  Measurements measured = Simulator(truth, readout).run(timeline, draw, 3, 1).measured;
  constexpr double period = 700.0, height = 3.0 * arcsec;
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i)
    measured.gimbal(2, static_cast<Eigen::Index>(i)) +=
        height * std::sin(2.0 * std::numbers::pi * timeline.intervals[i].t1 / period);
  const Diagnosis d =
      diagnose(base_filter(Coupling::eq5), {timeline, readout, measured}, {}, {}, {});
  EXPECT_EQ(d.verdict, Verdict::named) << report::sentence(d);
  ASSERT_EQ(d.causes.size(), 1u);
  EXPECT_EQ(d.causes[0].term, "warmup_drift");
  const auto told = std::ranges::find_if(
      d.remarks, [](const Remark& r) { return std::holds_alternative<remark::PeriodExplains>(r); });
  ASSERT_NE(told, d.remarks.end());
  const auto& r = std::get<remark::PeriodExplains>(*told);
  EXPECT_TRUE(r.beside_cause);
  EXPECT_EQ(r.equation, "gimbal inner");
  EXPECT_NEAR(r.period_s, period, 0.01 * period);
}

}  // namespace
}  // namespace drift::diagnosis::periodic_diagnosed_test
