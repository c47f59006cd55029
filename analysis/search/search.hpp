#pragma once

#include "analysis/search/cause.hpp"
#include "analysis/search/pairs.hpp"
#include "analysis/search/refit.hpp"

namespace drift::search {

/// How sure a diagnosis must be.
struct SearchOptions {
  double alpha = 0.02;     ///< chance of a false alarm over everything that is tried
  double credible = 0.95;  ///< probability that the listed causes must hold together
  int draws = 4000;        ///< of the null distribution
  std::size_t most_refits = 6;
};

/// What the search for causes found.
struct Search {
  Nulls nulls;
  inference::MaxNull pairs;
  double p_library = 1.0, p_scan = 1.0, p_pairs = 1.0, p_lone = 1.0;
  double other_equation = 0.0;  ///< other_equation_gain()
  double p_value = 1.0;         ///< of the strongest family, for all families together
  bool significant = false;
  std::vector<Refit> sets;  ///< adequate explanations in the credible set, most probable first;
                            ///< each may hold several simultaneous causes
  std::vector<double> probability;  ///< of each
  bool just_not = false;            ///< none of the sets is adequate; what they leave may be chance
  std::vector<Refit> rejected;      ///< the most probable ones that leave something significant
  std::vector<Remainder> linear;    ///< of every single candidate, from the linearised test
};

/// Names what is missing (discovery.md 2.3 to 2.7): detection by the largest projected score; the
/// adequate set, first of single candidates, then of all pairs, then by greedy steps, each
/// confirmed by a fit through the full dynamics; probabilities from their evidence. `nominal` may
/// have its noise replaced by one estimated with a real effect in the mean.
Search search(Examination& nominal, const inference::Test& test, const SearchOptions& options);

/// Whether and how well the other member of {eq5, eq6} explains the test: twice the log likelihood
/// gained by changing the equation and fitting again. -infinity for other couplings.
double other_equation_gain(const Examination& nominal, const inference::Test& test);

}  // namespace drift::search
