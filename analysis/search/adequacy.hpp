#pragma once

#include "analysis/inference/candidate.hpp"
#include "analysis/inference/scan.hpp"

namespace drift::search {

/// Everything that competes to explain a misfit, at one linearisation and noise model.
struct Field {
  const inference::CandidateSet* set = nullptr;
  const inference::Projected* projected = nullptr;
  const std::vector<inference::PositionScan>* scans = nullptr;
  std::vector<std::vector<inference::Contrast>> contrasts;  ///< of each candidate and variant
  /// What a candidate's score owes to priors alone, taken off it (empty: nothing). lambda rescales
  /// the misalignments; their prior cost is all that it can gain where the data do not tell.
  std::vector<double> discount;
  double discount_of(std::size_t candidate) const {
    return discount.empty() ? 0.0 : discount[candidate];
  }

  Field(const inference::CandidateSet& candidates, const inference::Projected& p,
        const std::vector<inference::PositionScan>& windows);
  /// All contrasts, for the null of the maximum.
  std::vector<inference::Contrast> all_contrasts() const;
};

/// A candidate's score against the nominal model.
struct Score {
  std::size_t variant = 0;  ///< the strongest
  double T = 0.0, strength = 0.0;
  int dof = 0;             ///< 0: unobservable
  double log_bayes = 0.0;  ///< log evidence against the nominal model, averaged over variants
};
Score score(const Field& field, std::size_t candidate);

/// Settings of a candidate at which its evidence is no less than beside them and within `nearly` of
/// the best, best first, at most `most`.
std::vector<std::size_t> best_settings(const Field& field, std::size_t candidate, double nearly,
                                       std::size_t most);

/// What is left when some causes are in the model, their amplitudes free.
struct Remainder {
  double library = 0.0;       ///< largest strength among the other candidates
  double scan = 0.0;          ///< largest strength among the windows
  std::size_t strongest = 0;  ///< the candidate that has `library`
};

/// A cause as it is put into the model: a candidate at one variant. The neighbouring variant on the
/// grid goes in with it, so that a time constant between two of them is allowed for.
struct Choice {
  std::size_t candidate = 0, variant = 0;
};

std::vector<int> columns_of(const Field& field, const std::vector<Choice>& choices,
                            bool with_neighbours);

/// Conditional scores T_(c|d) (discovery.md 2.5). Members of a chosen candidate's own family (same
/// term, parameters among its own) do not count as others. stop: give up (and return what was
/// found) as soon as a candidate's strength exceeds it.
Remainder remainder(const Field& field, const std::vector<Choice>& choices, double stop);

/// Log evidence of simultaneous causes against the nominal model, amplitudes of unknown size
/// (size_prior.hpp).
double log_bayes(const inference::Projected& p, const std::vector<int>& columns);

/// Cosine of what is left of two candidates' signatures; of several dimensions the largest
/// canonical one.
double cosine(const inference::Projected& p, const std::vector<int>& a, const std::vector<int>& b);

}  // namespace drift::search
