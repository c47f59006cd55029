#pragma once

#include "analysis/forms/form.hpp"
#include "analysis/inference/projector.hpp"

namespace drift::forms {

/// Bins of time that lie within positions: the grain at which forms are screened.
struct Bins {
  std::vector<std::pair<std::size_t, std::size_t>> intervals;  ///< of each: first, end
  std::vector<int> position;                                   ///< from 0
  std::vector<double> start;                                   ///< in the clock of equations [s]
  double length = 0.0;                                         ///< of most [s]

  Eigen::Index size() const { return static_cast<Eigen::Index>(intervals.size()); }
  /// Means over the bins of columns over the intervals.
  MatX mean(const MatX& of_intervals) const;
};
/// most: of all together; no position has fewer than four.
Bins bins_of(const Timeline& timeline, std::size_t most = 400);

/// What the data say of an input at one place that is constant in every bin, the nominal
/// parameters and attitudes projected out.
struct PlaceInformation {
  MatX C;             ///< shape (bins, bins)
  VecX g;             ///< shape bins
  VecX raw;           ///< information before the parameters took their part
  double unit = 1.0;  ///< size of the input in SI that C and g are scaled to

  /// Score of an input with these columns (values in the bins); `dof` 0: nothing of it is seen.
  struct Score {
    double T = 0.0;
    int dof = 0;
    VecX amplitude;  ///< at its best, SI
  };
  Score score(const MatX& columns) const;
  /// Whether information C on an input of `size` (raw information at most) is more than rounding.
  static bool seen(double C, double most_raw);
};

/// What a unit input in each bin does to the rows, shape (rows, bins).
MatX signatures_of(const OwnTarget& place, const Bins& bins, const inference::MeasuredRows& rows,
                   const Timeline& timeline);

PlaceInformation information_on(const OwnTarget& place, const Bins& bins,
                                const inference::MeasuredRows& rows, const Timeline& timeline,
                                const inference::Projector& projector);

}  // namespace drift::forms
