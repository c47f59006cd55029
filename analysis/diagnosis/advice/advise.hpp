#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/diagnosis/findings/diagnosis.hpp"
#include "analysis/inference/thresholds.hpp"
#include "mc/study/study.hpp"

namespace drift::diagnosis {

/// How advice is looked for.
struct AdviseOptions {
  std::size_t most = inference::AdviceLimits::most;  ///< additions to the plan
  double wanted =
      inference::AdviceLimits::wanted;  ///< separation that is enough: found almost surely [sigma]
  std::uint64_t seed = 1;               ///< of the simulation that verifies it
  /// On request: terms, axes of them or parameters that are to be told apart and from the nominal
  /// model. Given and empty: what the verdict suggests. Not given: advice only where the verdict
  /// needs it.
  std::optional<std::vector<std::string>> asked = std::nullopt;
};

/// Extra positions that separate what a diagnosis could not (alternatives.hpp says what that is):
/// the alternatives of an ambiguous verdict, the two equations where the test is blind to lambda.
/// On request also: named causes from what they can be confused with; of a consistent recording,
/// every effect of one prior sigma that this plan shows with less than `wanted`; or the terms asked
/// for.
///
/// Of a pool (position_pool.hpp) of orientations, case headings, command laws, slews and dwells,
/// the additions are taken that bring the pairs nearest to `wanted` (choose_additions.hpp).
/// Information of added positions is summed: a drift that walks from one caging to the next is
/// taken as known in each alone. With lambda in question, misalignments are taken as large as the
/// test allows (root mean square): lambda shows in proportion to them.
///
/// Verified: the extended test is simulated with the closest pair's truth and fitted with both;
/// verified_sigma is the root of the difference of their costs (expected_sigma give or take 1).
///
/// What no position can tell has no plan but is said: a pair whose traces are alike in the whole
/// pool taken together, and what three additions leave below 2 sigma. Advice with a plan comes
/// first. Empty if nothing is to be separated (and nothing was asked). recordings: as they were
/// diagnosed. InputError (usage) for terms that cannot be asked for.
std::vector<Advice> advise(const mc::Study& study, const std::vector<Recording>& recordings,
                           const Diagnosis& diagnosis, const AdviseOptions& options = {});

}  // namespace drift::diagnosis
