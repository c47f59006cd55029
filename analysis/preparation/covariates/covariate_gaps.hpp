#pragma once

#include <string>
#include <vector>

#include "core/params/covariates.hpp"
#include "core/recording/recording.hpp"

namespace drift::preparation {

/// A column that terms may follow: a covariate, a component of one, or named by an own term.
struct FollowedColumn {
  std::string name;
  CovariateSet set = 0;  ///< the bit of what it is, or is of
};
std::vector<FollowedColumn> followed_columns();

/// Rows of a recording in which such a column has no reading.
struct ColumnGaps {
  FollowedColumn column;
  std::size_t rows = 0, of = 0;         ///< without a reading, of all
  double seconds = 0.0, longest = 0.0;  ///< that they last, and that they do at a stretch
  std::size_t line = 0;                 ///< of the first row of the longest stretch
  std::size_t unknown = 0;              ///< of the rows: left without a number
};

/// Puts straight lines where columns that terms may follow have no reading, and the nearest reading
/// before the first and behind the last. A column may be read in every fifth row, or now and then:
/// a row is taken to be known if no reading is farther from it than readings usually are from each
/// other there (row_spacing() of those), in the time that was recorded; of all that are usual one
/// may be missing. Where more are, nobody knows what was in between, and the rows stay without a
/// number. A single reading holds for all rows; a column without any is left as it is. `planned`:
/// as for row_spacing().
std::vector<ColumnGaps> bridge_covariates(Recording& recording,
                                          const std::vector<double>& planned = {});

}  // namespace drift::preparation
