#pragma once

#include <string>
#include <vector>

#include "analysis/identification/identify.hpp"
#include "analysis/report/page/table.hpp"

namespace drift::report {

/// Filter, equation and terms, one line each.
std::vector<std::string> filter_lines(const FilterSpec& filter);

/// Of every start: status, and EKF NIS per degree of freedom and batch cost per degree of freedom
/// with the 95 % band a right model would be in (chi-square, Wilson-Hilferty).
Table fit_table(const mc::Study& study, const identification::Identification& id,
                std::size_t filter);

/// How the estimates are laid out.
struct EstimateLayout {
  std::size_t starts = 3;     ///< EKF columns at most
  bool unit_columns = false;  ///< unit and prior sigma in columns of their own, not in headings
};

/// Truth, prior, EKF and batch estimates, learning ratio and start consistency of every parameter,
/// grouped by term.
Table estimate_table(const mc::Study& study, const identification::Identification& id,
                     std::size_t filter, const EstimateLayout& layout);

/// The exact degeneracies of the test under this filter; without rows if there are none.
Table degeneracy_table(const mc::Study& study, const identification::Identification& id,
                       std::size_t filter);

/// What a reader must not miss: which filter depends on its start, whose residuals are not what it
/// believes, what did not converge, what cannot be seen. One sentence each.
std::vector<std::string> headlines(const mc::Study& study,
                                   const identification::Identification& id);

/// "Simulated, truth eq5" or "Recording a.csv, b.csv".
std::string source_line(const mc::Study& study, const identification::Identification& id);

}  // namespace drift::report
