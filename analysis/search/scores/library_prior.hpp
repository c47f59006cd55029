#pragma once

#include <cmath>
#include <map>
#include <string>

#include "analysis/inference/noise/lone_input.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/search/scores/choice.hpp"

namespace drift::search {

/// Prior of simultaneous causes among all that the library offers: every term alike, shared by the
/// candidates it offers, and missing or not whatever else is missing. As nothing is missing with
/// the probability PosteriorPrior::nothing, the mean number of terms that are is minus its log (the
/// law of Poisson), which all terms share: so much each further cause has. counts: whether a
/// candidate is offered at all.
class LibraryPrior {
 public:
  template <class Counts>
  LibraryPrior(const inference::CandidateSet& set, Counts&& counts) : set_(set) {
    for (std::size_t k = 0; k < set.candidates.size(); ++k)
      if (counts(k)) offers_[set.candidates[k].term] += 1.0;
  }
  explicit LibraryPrior(const inference::CandidateSet& set)
      : LibraryPrior(set, [](std::size_t) { return true; }) {}

  double log_of(const Explanation& choices) const { return log_within(choices) - log_terms(); }
  /// The same among explanations alone, which share that the first term is one of all.
  double log_within(const Explanation& choices) const {
    const double log_missing = std::log(-std::log(inference::PosteriorPrior::nothing));
    double sum = (log_missing - log_terms()) * static_cast<double>(choices.size() - 1);
    for (const Choice& choice : choices) {
      const inference::Candidate& c = set_.candidates[choice.candidate];
      sum += c.log_prior;
      if (const auto at = offers_.find(c.term); at != offers_.end()) sum -= std::log(at->second);
    }
    return sum;
  }

 private:
  double log_terms() const {
    return std::log(std::max<double>(1.0, static_cast<double>(offers_.size())));
  }

  const inference::CandidateSet& set_;
  std::map<std::string, double> offers_;
};

/// What must be added to half of the gain of something of free form in one equation for its log
/// evidence: where it sits and how fast it varies is one of WeighLimits::forms, its size has
/// Schwarz's price.
inline double log_price_of_free_form(const inference::MeasuredRows& rows) {
  return -std::log(inference::WeighLimits::forms) -
         0.5 * std::log(static_cast<double>(rows.rows()));
}
/// Its log evidence against nothing beside the model.
inline double log_free_form(const inference::LoneEffect& lone,
                            const inference::MeasuredRows& rows) {
  return 0.5 * lone.gain + log_price_of_free_form(rows);
}

}  // namespace drift::search
