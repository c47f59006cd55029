#pragma once

#include <vector>

#include "analysis/diagnosis/findings/remark.hpp"

namespace drift::diagnosis {

/// What the recording may be, and how probable that is; all together 1 (search/posterior.hpp). Of a
/// recording on a case there are none.
struct Probabilities {
  double consistent = 0.0, noise_only = 0.0, outside = 0.0;
  struct Explanation {
    std::vector<NamedEffect> causes;
    double probability = 0.0;
    bool other_priors = false;  ///< the other way round about the priors of the model
  };
  std::vector<Explanation> named;  ///< most probable first
  double wrong_priors = 0.0;       ///< of `consistent`: nothing missing, priors of the model wrong
  /// Of all these, the other way round about the priors of the model: all right where what is told
  /// takes some for wrong, and else some wrong with something missing besides.
  double other_priors = 0.0;
  bool known() const { return consistent + noise_only + outside > 0.0 || !named.empty(); }
};

}  // namespace drift::diagnosis
