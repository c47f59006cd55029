#pragma once

#include "analysis/search/fitted.hpp"
#include "analysis/search/scores/log_sum.hpp"

namespace drift::search {

/// Log of the evidence of causes over all their settings, against that of a fit that begins at
/// theirs: every point of the library's grid at which a cause can be seen is as likely as another,
/// and counts as much of that fit's evidence as its linearised evidence is of theirs, at most all.
/// Where one setting alone will do, log(1 / points); where the test does not tell them apart, 0.
double log_share_of_settings(const Fitted& nominal, const Explanation& choices);

/// The setting of a candidate that the linearised test prefers.
struct BestSetting {
  std::size_t variant = 0;
  double log_evidence = never;        ///< over all settings, by their shares
  double log_all_against_this = 0.0;  ///< that against the evidence of the best alone
};
BestSetting best_setting(const inference::CandidateSet& set, const inference::Projector& projector,
                         std::size_t candidate);

}  // namespace drift::search
