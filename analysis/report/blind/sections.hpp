#pragma once

#include "analysis/report/blind/report.hpp"
#include "analysis/report/page/json.hpp"
#include "analysis/report/page/wording.hpp"

namespace drift::report {

/// What is said of a blind study, in this order.
DRIFT_SECTIONS(BlindResults, blind_sections, targets, power, reliability, groups, further, others,
               confusion, misses);
inline constexpr Part blind_parts[] = {Part::evidence, Part::evidence, Part::how_sure,
                                       Part::details,  Part::details,  Part::details,
                                       Part::how_sure, Part::how_sure};

/// The other methods and ours; also `rivals` of blind.json.
Table rivals_table(const BlindResults& results);

Json blind_document(const BlindResults& results);

}  // namespace drift::report
