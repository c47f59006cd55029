#pragma once

#include <optional>

#include "analysis/search/fitted.hpp"
#include "analysis/search/scores/choice.hpp"

namespace drift::search {

struct Search;

/// The other of eq. (5) and (6) in the place of the nominal one, all else as it is.
struct OtherEquation {
  FilterSpec filter;
  BatchResult fit;
  /// Of twice the log likelihood, under the noise of the nominal model; where that was found to
  /// drive the platform, of twice the log evidence if its own noise makes that more. Either way
  /// more than T has a chance of exp(-T / 2) at most where the nominal one holds.
  double gain = 0.0;
};

/// Fitted from the nominal fit and from the prior; empty for couplings that have no other.
std::optional<OtherEquation> fit_other_equation(const Fitted& nominal, const MeasuredTest& test);

/// A wrong equation together with an effect.
struct BesideEquation {
  Explanation choices;
  double log_bayes = 0.0;  ///< log evidence against the nominal model, linearised
};

/// What leaves nothing where the other equation is the nominal one, best first. Neither shows
/// alone: the misalignments take up the effect under the wrong equation, and without the effect the
/// right one may fit worse than the wrong. noise: what an adequate explanation left, which any
/// other of the same recording will leave, too; null: not known, so that noise and effects are to
/// be told apart under that equation first (settle_noise, half of a whole diagnosis).
std::vector<BesideEquation> beside_other_equation(const Search& s, const MeasuredTest& test,
                                                  const inference::NoiseEstimate* noise);

}  // namespace drift::search
