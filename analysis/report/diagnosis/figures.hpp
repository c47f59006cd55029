#pragma once

#include <vector>

#include "analysis/diagnosis/diagnosis.hpp"
#include "analysis/report/identify/figures.hpp"

namespace drift::report {

/// Where the misfit is: heat map of channels and positions (where.svg), and the recovered signals
/// with band, located windows and the winner's signature (signal.svg).
std::vector<Figure> where_figures(const diagnosis::Diagnosis& diagnosis);

/// Scores of the strongest candidates (candidates.svg) and cosines between causes (cosines.svg).
std::vector<Figure> name_figures(const diagnosis::Diagnosis& diagnosis);

/// Before and after: residuals (residuals.svg), held-out prediction (held_out.svg), parameters that
/// moved (moved.svg).
std::vector<Figure> fit_figures(const diagnosis::Diagnosis& diagnosis);

}  // namespace drift::report
