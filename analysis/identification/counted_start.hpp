#pragma once

#include <functional>
#include <vector>

#include "analysis/identification/identify.hpp"

namespace drift::identification {

/// Which start of a filter is believed, by its place among the runs, and how many agree with it.
struct CountedStart {
  std::size_t start = 0;
  std::size_t agreeing = 0;          ///< starts, itself with them; 0 where none converged
  std::vector<std::size_t> as_good;  ///< that cost less than 1 more than the least, by place
};

/// Whether the starts of a filter were given the same measurements.
enum class Measured { once, by_each_start };

/// Of the starts whose judged() result converged that of least cost: all seek the same least cost,
/// chi-square of data and prior in the batch fit, of its innovations in the EKF (-2 log likelihood
/// of the data, as the covariances of the innovations are those of one plan and prior). What the
/// gate of `outliers` leaves out of one of them alone costs the gate squared, where it is cut off.
/// Of those that agree with it and cost less than 1 more, which is within one sigma of it, the
/// first. Where each start had measurements of its own their costs cannot be compared: the first
/// that converged. Where none did: the first.
///
/// Starts agree where StartVerdict is `consistent` of the two in every parameter; of an EKF, once
/// what a linear one keeps of its start is taken off (physics.md 3.5).
///
/// runs: of this filter, at least one, as Identification::runs_of() gives them.
CountedStart counted_start(const FilterSpec& filter, const std::vector<const FilterRun*>& runs,
                           Measured measured);

/// Converged, and no misfit.
bool fits(const EstimateResult& result);

/// Where no start of a filter that draws them fits, the prior mean is tried as one more after them:
/// from afar a fit may end in another valley. It is kept, as the run that counts, where it fits.
/// estimate: of a filter of the study from a start, which is start_count() here. For one test.
void try_prior_means(const mc::Study& study, Identification& id,
                     const std::function<FilterRun(std::size_t, std::size_t)>& estimate);

}  // namespace drift::identification
