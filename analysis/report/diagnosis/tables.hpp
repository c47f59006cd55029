#pragma once

#include <vector>

#include "analysis/diagnosis/diagnosis.hpp"
#include "analysis/report/page/table.hpp"

namespace drift::report {

// The tables of a diagnosis, for the terminal and for the page. `most` limits the rows; what is
// left out is said below the table.
Table cause_table(const diagnosis::Diagnosis& diagnosis);
Table candidate_table(const diagnosis::Diagnosis& diagnosis, std::size_t most);
Table fit_table(const diagnosis::Diagnosis& diagnosis);
Table moved_table(const diagnosis::Diagnosis& diagnosis, std::size_t most);
Table noise_table(const diagnosis::Diagnosis& diagnosis);
Table window_table(const diagnosis::Diagnosis& diagnosis, std::size_t most);
Table advice_table(const diagnosis::Advice& advice);

}  // namespace drift::report
