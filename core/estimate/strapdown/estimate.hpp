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

/// Indices of the parameters of a group, "D_I" -> D_I_x, D_I_y, D_I_z.
template <FixedString Group>
std::vector<std::size_t> group() {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    if (TermLibrary::specs[i].group.view() == Group.view()) indices.push_back(i);
  return indices;
}

}  // namespace drift::strapdown
