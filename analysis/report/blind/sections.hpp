#pragma once

#include "analysis/report/blind/report.hpp"
#include "analysis/report/page/json.hpp"
#include "analysis/report/page/wording.hpp"

namespace drift::report {

/// What is said of a blind study, in this order.
DRIFT_SECTIONS(BlindResults, blind_sections, targets, power, groups, further, confusion, misses);

Json blind_document(const BlindResults& results);

}  // namespace drift::report
