// Something periodic that no term describes: found, located and said with its period.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/report/diagnosis/sentence.hpp"
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

}  // namespace
}  // namespace drift::diagnosis::periodic_diagnosed_test
