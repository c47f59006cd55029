#pragma once

#include "core/estimate/batch.hpp"

namespace drift::equation {

/// fit_batch(), and where the filter estimates lambda, from both equations too: lambda held at 0
/// and at 1 until everything else has been fitted, then free. The best of the three.
///
/// lambda and the misalignments E are bilinear (the test shows (1 - lambda) E, or lambda E in
/// slews): the cost is a narrow bent valley, along which steps are short, with a second one on the
/// far side of the equation under which E would vanish. One start may end in the wrong one.
BatchResult fit_either_equation(const FilterSpec& filter, const MeasuredTest& test,
                                const Theta& start);

}  // namespace drift::equation
