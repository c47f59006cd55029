#pragma once

#include <vector>

#include "analysis/diagnosis/findings/fit_comparison.hpp"
#include "analysis/inference/linear_problem.hpp"
#include "core/sim/measurements.hpp"

namespace drift::diagnosis {

/// What is held out at once.
struct HeldOutPart {
  Fold::Of of = Fold::Of::position;
  int number = 0;               ///< of it, 1-based
  std::vector<int> positions;   ///< 1-based
  std::vector<bool> intervals;  ///< marked: held out
};

/// Every position; none where there is only one.
std::vector<HeldOutPart> positions_of(const inference::MeasuredRows& rows);

/// Every recording of several. ends: interval behind the last of each.
std::vector<HeldOutPart> recordings_of(const inference::MeasuredRows& rows,
                                       const std::vector<std::size_t>& ends);

/// Measurements with those of the marked intervals taken out.
Measurements without_intervals(const Measurements& measured, const std::vector<bool>& left_out);

}  // namespace drift::diagnosis
