#include "core/estimate/strapdown/retimed.hpp"

#include "core/base/check.hpp"

namespace drift::strapdown {

CaseTest retimed(CaseTest test, double factor) {
  DRIFT_EXPECTS(factor > 0.0);
  for (Interval& i : test.timeline.intervals) {
    i.t0 *= factor;
    i.t1 *= factor;
    if (!i.turn) continue;
    // What a lever arm feels of w' is skew, of w^2 symmetric (TurnReading).
    const Mat3 squares = 0.5 * (i.turn->arm + i.turn->arm.transpose());
    i.turn->arm = squares + (i.turn->arm - squares) / factor;
  }
  for (auto& [begin, end] : test.read_over) {
    begin *= factor;
    end *= factor;
  }
  test.row *= factor;
  place_nodes(test.timeline, test.R_lp,
              test.timeline.site.north_known ? longest_turn_row : longest_turn_row_one_way);
  return test;
}

}  // namespace drift::strapdown
