#pragma once

#include <algorithm>

#include "analysis/inference/thresholds.hpp"
#include "analysis/search/chance_thresholds.hpp"
#include "analysis/search/scores/remainder.hpp"

namespace drift::search {

/// How large an effect may be: as the library expects, or whatever the test says (size_prior.hpp).
enum class Sizes { of_library, as_found };

/// A model with causes put in, fitted again through the full dynamics.
struct Refit {
  std::vector<Choice> choices;  ///< into the nominal fit's candidates
  FilterSpec filter;
  Fitted after;         ///< scored again, noise estimated again
  Remainder remainder;  ///< largest strengths that are left
  double excess = 0.0;  ///< by how much (log of a chance) what is left exceeds what is allowed; <=
                        ///< 0: nothing is left
  bool as_found = false;  ///< an amplitude lies beyond what its prior makes credible at all
  bool nameable = true;   ///< false: lambda that is not clearly another equation's
  bool adequate() const { return excess <= 0.0 && nameable; }
  /// What is left may be chance: one in twenty of those that the threshold lets through.
  bool tolerable() const { return excess <= inference::WeighLimits::tolerable; }
  double log_bayes = 0.0;   ///< log evidence against the nominal model, both with their own noise
  bool sign_agrees = true;  ///< amplitudes came out with the sign the score predicted
  /// Whether it is to be preferred to another one of the same causes.
  bool better_than(const Refit& other) const {
    if (tolerable() != other.tolerable()) return tolerable();
    return log_bayes - std::max(0.0, excess) > other.log_bayes - std::max(0.0, other.excess);
  }
};

/// The noise that is looked for beside a cause: such as drives the platform if the nominal model
/// needed it. What one cause leaves is not noise because it is slow.
NoiseKinds noise_beside(const Fitted& nominal);

/// Fits causes (fit_causes.hpp) and scores everything again. Of sizes as the library expects and,
/// where one is far beyond it, as found, what has more evidence. Where the nominal misfit was too
/// gross for its noise to be looked for, what drives the platform is looked for beside causes that
/// leave some of it.
Refit refit(const Fitted& nominal, const MeasuredTest& test, const std::vector<Choice>& choices,
            const ChanceThresholds& thresholds, NoiseKinds kinds, Sizes sizes);

/// Time constants of the causes, as a fit has them, that lie beyond the ends of the grids on which
/// they were looked for (moments have none). None beside lambda, which is all but held.
std::vector<std::size_t> settings_beyond_grid(const inference::CandidateSet& set, const Refit& r);

/// A setting that a fit took beyond the library's grid is held back by its prior, which stands for
/// the distance of grid points: the fit is made again with one as wide as the setting itself. Where
/// the first one lies outside the 95 % interval of that, what the test says of it is stated, and of
/// all that goes with it; how probable the causes are stays as the library's settings make it.
void give_settings_room(Refit& r, const Fitted& nominal, const MeasuredTest& test,
                        const ChanceThresholds& thresholds, NoiseKinds kinds);

/// Each explanation fitted, spread over threads.
std::vector<Refit> refit_all(const Fitted& nominal, const MeasuredTest& test,
                             const std::vector<Explanation>& all,
                             const ChanceThresholds& thresholds, NoiseKinds kinds, Sizes sizes);

}  // namespace drift::search
