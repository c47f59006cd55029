#pragma once

#include "analysis/report/blind/report.hpp"
#include "analysis/report/page/json.hpp"
#include "analysis/report/page/wording.hpp"

namespace drift::report {

/// What is said of a blind study, in this order.
DRIFT_SECTIONS(BlindResults, blind_sections, (targets, evidence), (power, evidence),
               (reliability, how_sure), (groups, details), (further, details), (others, details),
               (confusion, how_sure), (misses, how_sure));

/// The other methods and ours; also `rivals` of blind.json.
Table rivals_table(const BlindResults& results);

Json blind_document(const BlindResults& results);

}  // namespace drift::report
