// A bias that is another after each turn-on: two recordings of one unit.
#include <gtest/gtest.h>

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/inference/noise/noise_component.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "tests/support/model_builders.hpp"
#include "tests/support/two_recordings.hpp"

namespace drift::diagnosis::turn_on_test {
namespace {

using namespace drift::test;

TEST(Diagnose, ABiasOfAnotherTurnOnIsInItsAccelerometerFromThatRecordingOnHoweverLarge) {
  const Timeline once = preset_timeline("twelve", CommandLaw::free, 1200.0, 120.0),
                 both = twice(once);
  const std::size_t n = once.intervals.size();
  FilterSpec nominal = base_filter(Coupling::eq5);
  nominal.active = only({"D_F"}) | params_named("accelerometer");
  TruthSpec truth = base_truth(Coupling::eq5);
  truth.active = nominal.active;
  const Readout readout;
  const TruthDraw unit = draw_truth(truth, once.chains, 5, 0);
  Simulator simulator(truth, readout);
  const Measurements alike = one_after_the_other(simulator.run(once, unit, 5, 1).measured,
                                                 simulator.run(once, unit, 5, 2).measured);
  DiagnoseOptions options;
  options.folds = FoldMethod::linear;
  options.whiteness_draws = 0;
  for (const double bias : {100e-6, 200e-6}) {
    SCOPED_TRACE(bias);
    Measurements measured = alike;
    measured.acc.row(0).tail(n).array() += bias;
    const Diagnosis d = diagnose(nominal, {both, readout, measured}, {}, {}, options, {n, 2 * n});
    EXPECT_EQ(d.verdict, Verdict::unexplained) << report::sentence(d);
    EXPECT_EQ(d.where.equation, "accelerometer x");
    ASSERT_FALSE(d.signals.empty());
    EXPECT_EQ(d.signals.front().equation, "accelerometer x");
    EXPECT_EQ(d.signals.front().shape.kind, Shape::Kind::onset);
    EXPECT_EQ(d.signals.front().shape.seconds, both.intervals[n].t0);
    const auto* input = remark_in<remark::FreeInputExplains>(d);
    ASSERT_TRUE(input);
    EXPECT_EQ(input->equation, "accelerometer x");
    EXPECT_TRUE(input->constant);
    // The noise is that of the instruments: the bias is none.
    EXPECT_TRUE(std::ranges::none_of(d.noise, [](const inference::NoiseFinding& f) {
      return f.significant && f.component == inference::acc_markov.name;
    }));
  }
}

}  // namespace
}  // namespace drift::diagnosis::turn_on_test
