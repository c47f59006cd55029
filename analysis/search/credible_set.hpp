#pragma once

#include "analysis/search/refit.hpp"

namespace drift::search {

/// What the best explanations may leave.
enum class Leftover { nothing, chance };

/// Whether there is an explanation with such sizes that leaves no more than that, and nothing
/// unknown in one equation explains the test far better than the best of all.
bool can_be_weighed(const Fitted& e, const std::vector<Refit>& refits, Leftover left, Sizes sizes);

/// The explanation of most evidence and prior of those that leave no more than chance; null if none
/// does.
const Refit* heaviest(const Fitted& e, const std::vector<Refit>& refits);

/// Numbers of those that leave no more than chance and whose log weight is within so much of the
/// heaviest.
std::vector<std::size_t> heaviest_within(const Fitted& e, const std::vector<Refit>& refits,
                                         double within);

/// Whether an explanation has been fitted.
bool is_among(const std::vector<Refit>& refits, const Explanation& in);

/// An explanation that is not needed to hold the probability `credible`.
struct Unlisted {
  Explanation choices;
  double probability = 0.0;
};

/// Explanations weighed against each other.
struct CredibleSet {
  std::vector<Refit> sets;          ///< most probable first; each may hold several causes
  std::vector<double> probability;  ///< of each
  std::vector<Refit> rejected;      ///< those that leave what is no chance
  std::vector<Refit> beside;        ///< all others
  std::vector<Unlisted> unlisted;   ///< of these what stands for nothing else, most probable first
};

/// Weighs explanations by evidence and prior; those up to the probability `credible` are kept. Of
/// several with one name the best stands for all (of the same causes with a setting in several
/// valleys the fit of least cost; each has the evidence of all settings, so the heaviest counts),
/// and what says more is left out where less will do.
///
/// Adequate ones and those whose leftover may be chance compete alike, the latter at the price of
/// that chance: a far better explanation beside which something unrelated is just significant must
/// not lose all to a poor one that happens to cover that too.
CredibleSet weigh(const Fitted& e, std::vector<Refit> refits, double credible);

}  // namespace drift::search
