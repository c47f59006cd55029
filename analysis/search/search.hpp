#pragma once

#include "analysis/search/credible_set.hpp"
#include "analysis/search/detect.hpp"
#include "analysis/search/scores/log_sum.hpp"

namespace drift::search {

/// What the search for causes found.
struct Search : Detection, CredibleSet {
  bool just_not = false;          ///< none of the sets is adequate; what they leave may be chance
  std::vector<Remainder> linear;  ///< of every single candidate, from the linearised test
  /// Sets and their probabilities where something outside the library is so much more probable that
  /// none of them is given: then there are no sets.
  std::vector<Refit> outweighed;
  std::vector<double> outweighed_probability;
  /// Log evidence, noise included, of a form outside the library (outside_form.hpp); where there is
  /// an explanation that it is to be compared with.
  double log_form = never;
};

/// Names what is missing: detection by the largest projected score; the
/// adequate set, first of single candidates, against which pairs stand where the linearised test or
/// something outside the library asks for them, then of all pairs, then by greedy steps, each
/// confirmed by a fit through the full dynamics; probabilities from their evidence. Where something
/// outside the library is credible by itself (0.95; posterior.hpp) all sets are outweighed.
Search search(Fitted nominal, const MeasuredTest& test, const SearchOptions& options);

/// The sets with what the test says of their settings, beyond the library's grids too (refit.hpp).
/// Once the posterior has been worked out, which is that of the library's settings.
void give_settings_room(Search& s, const MeasuredTest& test);

}  // namespace drift::search
