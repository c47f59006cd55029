#pragma once

#include "analysis/blind/score.hpp"
#include "core/stats/proportion.hpp"

namespace drift::blind {

/// How one way of answering did on the sealed trials.
struct RivalScore {
  std::string name;
  stats::Proportion false_alarms;         ///< nothing hidden
  stats::Proportion noise_alarms;         ///< noise not as declared
  stats::Proportion detected;             ///< of all effects
  stats::Proportion right, among, wrong;  ///< of single effects: that name alone; among others;
                                          ///< none of the names is right
};

RivalScore rival_score(std::string name, const std::vector<TrialScore>& scores);

/// The rivals on the trials of a folder, its key sealed before; the trials are spread over threads.
std::vector<RivalScore> score_rivals(const std::string& folder, double alpha, int threads);

}  // namespace drift::blind
