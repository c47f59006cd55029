#pragma once

#include "core/estimate/strapdown/case_test.hpp"

namespace drift::strapdown {

/// The test as it is with every time `factor` times as long: a clock that is not what was written
/// down. Readings are rates and stay, and with them means in dwells; over a row they turn the case
/// by as much more. Rows hold the samples that they held and noise stays as it was found, so that
/// two fits can be compared. DRIFT_EXPECTS: factor above zero.
CaseTest retimed(CaseTest test, double factor);

}  // namespace drift::strapdown
