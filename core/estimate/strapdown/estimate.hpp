#pragma once

#include <vector>

#include "core/physics/term_library.hpp"

namespace drift::strapdown {

/// Values of some parameters of TermLibrary, from data; all others are zero.
struct Estimate {
  std::vector<std::size_t> params;  ///< which, as indices of TermLibrary
  Theta theta = Theta::Zero();      ///< SI
  MatX covariance;                  ///< of `params`, SI; infinite where the data say nothing
  double rms = 0.0;                 ///< of the residuals, in the unit of the fit
  bool converged = true;
};

}  // namespace drift::strapdown
