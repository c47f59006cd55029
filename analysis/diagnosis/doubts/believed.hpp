#pragma once

#include <optional>

#include "analysis/diagnosis/findings/probabilities.hpp"
#include "analysis/search/posterior.hpp"

namespace drift::diagnosis {

/// What is missing from the nominal model, with the priors that are the more probable: as declared,
/// or with room for those that are wrong.
struct Believed {
  FilterSpec nominal;
  bool wrong_priors = false;  ///< it has room for those
  search::Search found;
  search::Posterior posterior;
  /// Priors that may be wrong where nothing else is (`explains`).
  std::optional<remark::BeyondPrior> instead;
  /// With room for those, where that is more probable than noise alone (`noise_beside`).
  struct WithRoom {
    FilterSpec filter;
    std::vector<inference::NoiseFinding> noise;
  };
  std::optional<WithRoom> with_room;
  std::optional<remark::OtherPriors> other;  ///< the other way round, where it is credible
  Probabilities other_way;                   ///< its parts, Posterior::other_priors together
};

/// found: with the priors of the nominal model. fit: of that, under declared noise. Wrong priors
/// are asked for where something stands out or the noise is not as declared; where neither is,
/// parameters far from their priors are told as they are.
Believed believed(const FilterSpec& nominal, const MeasuredTest& test, const BatchResult& fit,
                  search::Search found, const search::SearchOptions& options);

/// A search's candidates as what is said of them.
std::vector<NamedEffect> named_effects(const search::Search& found,
                                       const search::Explanation& choices);

}  // namespace drift::diagnosis
