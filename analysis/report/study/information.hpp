#pragma once

#include "analysis/report/study/results.hpp"

namespace drift::report {

/// What the information in the plan promises beside what the runs found, parameter by parameter,
/// for every pair of the first points; and why they differ where they do.
std::vector<Section> information_sections(const StudyResults& results, int threads);

}  // namespace drift::report
