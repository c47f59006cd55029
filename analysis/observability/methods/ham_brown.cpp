#include <fmt/format.h>

#include <algorithm>

#include "analysis/observability/methods/method.hpp"

namespace drift::observability {
namespace {

/// The direction a state takes most part in.
const EigenDirection& home_of(const Ranking& r, std::size_t state) {
  return *std::ranges::max_element(r.spectrum, {},
                                   [&](const EigenDirection& d) { return d.participation(state); });
}

std::string ham_brown_reason(const Ranked& r, std::size_t state, bool higher_here) {
  const EigenDirection& d = home_of(r.ranking, state);
  return fmt::format("judged by one direction that holds {:.1f} % of it: {}{}",
                     100.0 * d.participation(state), name_of(d, r.ranking.layout),
                     higher_here ? "; the rest lies in directions seen much worse" : "");
}

VecX ham_brown_of(const Ranked& r) {
  return ham_brown_score(r.ranking);
}

}  // namespace

VecX ham_brown_score(const Ranking& ranking) {
  const auto n = static_cast<Eigen::Index>(ranking.layout.size());
  double trace = 0.0;  // of the posterior, of what walks at the beginning
  for (const EigenDirection& d : ranking.spectrum) trace += 1.0 / (1.0 + d.information);
  VecX score(n);
  for (Eigen::Index k = 0; k < n; ++k)
    score[k] = -static_cast<double>(n) /
               (1.0 + home_of(ranking, static_cast<std::size_t>(k)).information) / trace;
  return score;
}

Method ham_brown() {
  return {"ham_brown", "Ham-Brown: eigenvalue of the dominant direction", ham_brown_of,
          ham_brown_reason};
}

}  // namespace drift::observability
