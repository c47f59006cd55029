#pragma once

#include "analysis/strapdown/case_errors.hpp"
#include "analysis/strapdown/case_study.hpp"
#include "analysis/strapdown/score.hpp"

namespace drift::strapdown {

/// How the dwells of a recording are held out of a fit.
struct Division {
  int folds = 0;    ///< parts; 0: too few dwells to hold any out
  int repeats = 1;  ///< ways to divide them, over which squares of errors are averaged
};

/// Six parts of six dwells or more. Of a unit whose gyros do not see the Earth twelve, since with a
/// dwell both its ways are lost to the fit and not its second alone, and in two divisions: its
/// dwells differ much from each other.
Division division_of(const CaseStudy& of);

/// Size of the errors of a model: up after a turn, gyros in dwells at rest, gravity in dwells.
struct CaseScores {
  Score up, gyro, gravity;  ///< [deg], [deg/h], [g]; empty without held-out data
};

/// Scores of a filter (case_filter) that was fitted: again without each part of the dwells, to
/// predict these and the ways that begin there. seed: of the divisions and of the bootstrap.
CaseScores scores_of(const FilterSpec& filter, const BatchResult& fit, const CaseStudy& of,
                     const Division& division, std::uint64_t seed);

}  // namespace drift::strapdown
