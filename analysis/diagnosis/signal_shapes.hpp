#pragma once

#include <vector>

#include "analysis/diagnosis/recovered.hpp"

namespace drift::diagnosis {

/// A shape that a recovered signal may have, bin by bin.
struct ShapeColumns {
  Shape shape;
  MatX columns;  ///< shape (bins, 1 or 2)
};

/// Time of the middle of a bin [s].
inline double middle_time(const Timeline& t, const std::pair<std::size_t, std::size_t>& bin) {
  return 0.5 * (t.intervals[bin.first].t0 + t.intervals[bin.second - 1].t1);
}

/// All shapes that are tried: of time, of what the platform feels, of positions, recordings and
/// covariates.
std::vector<ShapeColumns> signal_shapes(const InputEstimate& input, const Timeline& timeline,
                                        const std::vector<preparation::Covariate>& covariates);

}  // namespace drift::diagnosis
