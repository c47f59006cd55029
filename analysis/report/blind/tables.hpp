#pragma once

#include <vector>

#include "analysis/blind/summary.hpp"
#include "analysis/report/page/table.hpp"

namespace drift::report {

/// "0.950 [0.888, 0.984] of 99"; "-" of nothing.
std::string text_of(const blind::Proportion& p);

/// All tables of a blind study: targets, power, plans and couplings, further scores, confusion.
std::vector<Table> tables_of(const blind::Summary& summary);

/// Every trial whose answer is wrong: what was hidden, what was answered.
Table misses_table(const std::vector<blind::TrialScore>& scores);

}  // namespace drift::report
