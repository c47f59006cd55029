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

/// The longest steps of a truth that own terms drive: an integrator that chooses its own steps over
/// a stretch of constant command would pass over what begins and ends within one.
class OwnTruthSteps {
 public:
  explicit OwnTruthSteps(const ModelSpec& truth);

  /// For a run with these parameters. Where its settings are those of the model, a timeline that
  /// was resolved says where steps must be fine; else it is found for those drawn.
  void of_run(const Timeline& timeline, const Theta& drawn);
  /// Over interval i [s]: an eighth of it, or as fine as an own term asks for; 0: no limit.
  double longest(const Timeline& timeline, std::size_t i) const;

 private:
  bool drives_ = false;
  ModelSpec truth_;
  std::vector<int> substeps_;  ///< of each interval for the settings drawn; empty: the timeline's
};

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
