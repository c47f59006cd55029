#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/search/cause.hpp"

namespace drift::diagnosis {

/// A form that fits what no known effect explains: not a cause. Held-out positions are predicted
/// better with it.
struct Proposal {
  std::string text;                                ///< a [[term]], as a study file takes it
  std::string acts_on;                             ///< "drift.x"
  std::string equation;                            ///< "A*f_x*f_z"
  std::string known;                               ///< the parameter of the library that leaves the
                                                   ///< same trace on this plan; empty: none does
  bool in_nominal = false;                         ///< which the nominal model estimates
  std::vector<search::CauseParameter> parameters;  ///< as fitted through the full dynamics
  std::size_t forms = 0;                           ///< that were tried
  double p_value = 1.0;                            ///< of its score by chance, over all of them
  std::size_t positions = 0;                       ///< held out, each by itself
  double held_out_gain = 0.0;                      ///< of their log score
  double chi2_per_dof_before = 1.0, chi2_per_dof_after = 1.0;  ///< of them
};

}  // namespace drift::diagnosis
