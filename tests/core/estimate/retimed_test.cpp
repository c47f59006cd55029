#include "core/estimate/strapdown/retimed.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/estimate/batch.hpp"
#include "tests/support/case_unit.hpp"

namespace drift::strapdown::retimed_test {
namespace {

double chi2_of(const CaseTest& test) {
  const FilterSpec filter = case_unit::filter_for(test, 0.01);
  return fit_batch(filter, {test.timeline, test.readout, test.measured}, make_layout(filter).theta)
      .estimate.statistic;
}

/// A clock that is wrong by half a per cent misfits; put right on the rows as they were laid out it
/// fits as a right one does.
TEST(Retimed, IsTheTestOfTheRightClock) {
  constexpr double wrong = 1.005;
  const Signals right =
      signals_of(strapdown_recording(case_unit::script(71), case_unit::sensors()));
  const std::vector<Dwell> dwells = find_dwells(right, {}).dwells;
  Signals slow = right;
  for (double& t : slow.time) t *= wrong;
  slow.interval *= wrong;
  std::vector<Dwell> of_slow = dwells;
  for (Dwell& d : of_slow) {
    d.start *= wrong;
    d.end *= wrong;
  }
  const CaseTest as_written = lay_out_case(slow, of_slow, case_unit::site, Carry::through),
                 as_it_was = lay_out_case(right, dwells, case_unit::site, Carry::through),
                 mended = retimed(as_written, 1.0 / wrong);
  ASSERT_NEAR(mended.row, as_it_was.row, 1e-9);
  EXPECT_NEAR(mended.timeline.intervals.back().t1, as_it_was.timeline.intervals.back().t1, 1e-6);
  const double at_right = chi2_of(as_it_was);
  EXPECT_NEAR(chi2_of(mended), at_right, 2.0);
  EXPECT_GT(chi2_of(as_written), at_right + 50.0);
}

/// Of what a lever arm feels the part of w' shrinks with longer times, that of w^2 stays.
TEST(Retimed, LeavesRatesAndStretchesAccelerations) {
  CaseTest test =
      case_unit::unit_of(case_unit::script(72), case_unit::sensors(), InTurns::read).test;
  const CaseTest longer = retimed(test, 2.0);
  bool turns = false;
  for (std::size_t k = 0; k < test.timeline.intervals.size(); ++k) {
    const Interval &was = test.timeline.intervals[k], &is = longer.timeline.intervals[k];
    EXPECT_NEAR(is.length(), 2.0 * was.length(), 1e-9);
    EXPECT_EQ((is.omega_cmd_p - was.omega_cmd_p).norm(), 0.0);
    if (!was.turn) continue;
    turns = true;
    EXPECT_EQ((is.turn->rate - was.turn->rate).norm(), 0.0);
    const Mat3 skew_was = was.turn->arm - was.turn->arm.transpose(),
               skew_is = is.turn->arm - is.turn->arm.transpose(),
               even_was = was.turn->arm + was.turn->arm.transpose(),
               even_is = is.turn->arm + is.turn->arm.transpose();
    EXPECT_LT((2.0 * skew_is - skew_was).norm(), 1e-12);
    EXPECT_LT((even_is - even_was).norm(), 1e-12);
  }
  EXPECT_TRUE(turns);
}

}  // namespace
}  // namespace drift::strapdown::retimed_test
