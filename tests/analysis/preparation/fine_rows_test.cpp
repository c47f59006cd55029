// A recording of second by second is taken as few rows, and what is estimated from those is what
// its sigmas say.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/preparation/prepare.hpp"
#include "analysis/preparation/recorded_test.hpp"
#include "core/estimate/batch.hpp"
#include "core/recording/rows/angles_around.hpp"
#include "core/sim/simulate.hpp"
#include "tests/support/pulls.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::preparation::fine_rows_test {
namespace {

TEST(FineRows, FewAreAsGoodAsTheySay) {
  mc::Study s = test::six_study(600.0, 1.0);
  s.readout.accelerometer_noise = 38.7e-6;  // 5 ug in a minute
  const Timeline timeline = lay_out(s.plan, s.site);
  Simulator simulator(s.truth, s.readout);
  test::Pulls few;
  double chi2 = 0.0, scalars = 0.0;
  for (std::uint64_t run = 0; run < 8; ++run) {
    const TruthDraw draw = draw_truth(s.truth, timeline.chains, 20261126, run);
    const Recording r =
        make_recording(timeline, simulator.run(timeline, draw, 20261126, run).measured, s.readout);
    const auto fit = [&](std::size_t most_rows) {
      const Prepared p = prepare(s, {r}, most_rows);
      const RecordedTest t = recorded_test(p.study, p.recordings);
      EXPECT_EQ(most_rows < 3600, !p.recordings[0].readings.empty());
      return fit_batch(s.filters[0], {t.timeline, p.study.readout, t.measured},
                       make_layout(s.filters[0]).theta);
    };
    const BatchResult of_few = fit(300);
    few.add(of_few.estimate, draw.theta);
    chi2 += of_few.data_chi2;
    scalars += static_cast<double>(of_few.estimate.measured);
    if (run == 0) {
      const BatchResult of_all = fit(3600);
      // Of twelve readings a parabola's centre is worth fewer, and the last of a position is one.
      const double less = 1.07 * std::sqrt(12.0 / AnglesAround(12, 1, 1.0).readings());
      for (std::size_t k = 0; k < of_all.estimate.parameters.size(); ++k)
        EXPECT_LT(of_few.estimate.parameters[k].sigma, less * of_all.estimate.parameters[k].sigma);
    }
  }
  test::expect_as_large_as_sigmas(few);
  // Parameters and attitudes of the cagings are fitted: 39 and 18 of some 1,800 scalars at most.
  const double spread = 4.0 * std::sqrt(2.0 * scalars);
  EXPECT_LT(chi2, scalars + spread);
  EXPECT_GT(chi2, scalars - 8.0 * 57.0 - spread);
}

}  // namespace
}  // namespace drift::preparation::fine_rows_test
