#pragma once

#include <limits>

#include "analysis/inference/scan.hpp"
#include "analysis/search/scores/choice.hpp"

namespace drift::search {

/// Everything that competes to explain a misfit, at one linearisation and noise model.
struct Field {
  inference::CandidateSet set;
  inference::Projected projected;
  std::vector<inference::PositionScan> scans;
  std::vector<std::vector<inference::Contrast>> contrasts;  ///< of each candidate and variant
  /// What a candidate's score owes to priors alone, taken off it (empty: nothing). lambda rescales
  /// the misalignments; their prior cost is all that it can gain where the data do not tell.
  std::vector<double> discount;

  Field() = default;
  Field(inference::CandidateSet candidates, inference::Projected p,
        std::vector<inference::PositionScan> windows);
  double discount_of(std::size_t candidate) const {
    return discount.empty() ? 0.0 : discount[candidate];
  }
  /// All contrasts, for the null of the maximum.
  std::vector<inference::Contrast> all_contrasts() const;
};

/// A candidate's score against the nominal model.
struct Score {
  std::size_t variant = 0;  ///< the strongest
  double T = 0.0, strength = 0.0;
  int dof = 0;             ///< 0: unobservable
  double log_bayes = 0.0;  ///< log evidence against the nominal model, averaged over variants
  /// The same of the sizes alone that the test can see, and their share of the prior.
  double log_bayes_visible = -std::numeric_limits<double>::infinity(), visible = 0.0;
};
Score score(const Field& field, std::size_t candidate);

/// Log evidence of simultaneous causes against the nominal model, amplitudes of unknown size
/// (size_prior.hpp).
double log_bayes(const inference::Projected& p, const std::vector<int>& columns);

/// The same at every variant of choices[which], the others as they are; -infinity where it cannot
/// be seen.
std::vector<double> evidence_of_settings(const Field& field, const Explanation& choices,
                                         std::size_t which);

/// Numbers of the settings at which the evidence is no less than beside them and within `nearly` of
/// the best, best first, at most `most`.
std::vector<std::size_t> best_of(const std::vector<double>& evidence, double nearly,
                                 std::size_t most);

/// These of a candidate alone.
std::vector<std::size_t> best_settings(const Field& field, std::size_t candidate, double nearly,
                                       std::size_t most);

/// Amplitudes, in prior sigmas, that the linear score expects of some columns: (C + 1)^-1 g, with
/// the unit prior, so that nothing runs away.
VecX expected_amplitudes(const inference::Projected& p, const std::vector<int>& columns);

/// Cosine of what is left of two candidates' signatures; of several dimensions the largest
/// canonical one.
double cosine(const inference::Projected& p, const std::vector<int>& a, const std::vector<int>& b);

}  // namespace drift::search
