#pragma once

#include <vector>

#include "analysis/identification/identify.hpp"
#include "analysis/report/page/table.hpp"

namespace drift::report {

/// Verdict on a start-consistency ratio as a cell: "starts agree", "doubtful", "depends on start".
/// "-" where there is no ratio.
Cell verdict_cell(double ratio);

/// Results of [[published]] beside ours, for every parameter: the published runs, our runs by EKF
/// and batch, the truth, and independent tests (published without a filter). One table for each set
/// of published filter runs, and for each other filter and independent test. Empty if nothing is
/// published.
std::vector<Table> published_comparison(const mc::Study& study,
                                        const identification::Identification& id);

}  // namespace drift::report
