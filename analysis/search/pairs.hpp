#pragma once

#include <functional>

#include "analysis/search/scores/remainder.hpp"

namespace drift::search {

/// Two candidates at once.
struct Pair {
  Choice a, b;
  double T = 0.0;  ///< joint score
  int dof = 2;
  double strength = 0.0;
  double log_bayes = 0.0;
};

/// All pairs of single-parameter candidates, strongest joint score first (at most `most`),
/// cancelling ones included: T = [g_a g_b] C^-1 [g_a g_b]'. Pairs that
/// leave the same trace (thresholds.hpp) are one effect under two names and left out.
std::vector<Pair> strongest_pairs(const Field& field, std::size_t most);

/// Largest pair strength under the null: threshold and p-values for strongest_pairs.
inference::MaxNull pair_null(const Field& field, int draws);

/// Whether a pair of such a log evidence is worth a look at what it leaves.
using WorthALook = std::function<bool(const Explanation& pair, double log_bayes)>;

/// Pairs that leave nothing significant, by evidence, best first (at most `most`, of the same terms
/// and axes at most two). Candidates of several parameters take part where their own score is among
/// the strongest. worth: empty, all are.
std::vector<Pair> adequate_pairs(const Field& field, const std::vector<Score>& scores,
                                 double library_threshold, double scan_threshold, std::size_t most,
                                 const WorthALook& worth = {});

}  // namespace drift::search
