#pragma once

#include <vector>

#include "core/physics/model_spec.hpp"
#include "core/plan/timeline.hpp"

namespace drift {

/// Makes the steps of a test as fine as its rows' means of a study's own terms ask for, and marks
/// where (Interval::fine): until the rules of the steps are within a thousandth of the term's
/// largest value, of at most 64 steps a row (32 of two). Amplitudes are one prior sigma from their
/// means, settings at theirs. Terms of which the timeline does not carry what they read are left
/// out.
void resolve_own_terms(Timeline& timeline, const ModelSpec& model);

/// An own term that changes too fast for the steps of a test.
struct UnresolvedOwnTerm {
  std::size_t own = 0;       ///< which of own_terms()
  double off = 0.0;          ///< error of its means over rows, over the term itself, both rms
  double longest_row = 0.0;  ///< [s]
};
/// Those of a model whose means are off by more than a twentieth, on a timeline that was resolved.
std::vector<UnresolvedOwnTerm> unresolved_own_terms(const Timeline& timeline,
                                                    const ModelSpec& model);

}  // namespace drift
