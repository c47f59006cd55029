#pragma once

#include <string>

#include "analysis/blind/sizing.hpp"

namespace drift::blind {

/// The effect of the library that looks most like a signal.
struct Nearest {
  std::string term, axis;
  double cosine = 0.0;  ///< between what the nominal fit leaves of both, 0..1; of several
                        ///< parameters their best mixture
};

/// Looks through every axis of every term that the nominal filter leaves out, at every point of the
/// grids of its nonlinear parameters. Above a cosine of 0.9, what is outside the library cannot be
/// told from what is in it: A^2 (1 - cosine^2) is what a perfect answer would have to go by.
/// A change of equation (frame_closure) is not looked at.
Nearest nearest_in_library(const SizingBench& bench, const FilterSpec& nominal, const VecX& signal);

}  // namespace drift::blind
