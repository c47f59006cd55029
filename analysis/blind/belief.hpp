#pragma once

#include <limits>
#include <vector>

#include "analysis/blind/trial.hpp"
#include "analysis/diagnosis/findings/probabilities.hpp"

namespace drift::blind {

/// What a diagnosis takes for most probable, and how probable it says that is.
struct Belief {
  enum class Kind { none, consistent, noise_only, named, outside };
  Kind kind = Kind::none;
  double probability = std::numeric_limits<double>::quiet_NaN();
  std::vector<diagnosis::NamedEffect> causes;  ///< where it is named
};
inline constexpr Named<Belief::Kind> belief_kinds[] = {{"none", Belief::Kind::none},
                                                       {"consistent", Belief::Kind::consistent},
                                                       {"noise_only", Belief::Kind::noise_only},
                                                       {"named", Belief::Kind::named},
                                                       {"outside", Belief::Kind::outside}};

Belief belief_of(const diagnosis::Probabilities& probabilities);

/// Whether that is what was hidden: nothing, noise, exactly these effects (an axis that one side
/// leaves open agrees), something outside the library.
bool is_right(const Belief& belief, const KeyEntry& key);

}  // namespace drift::blind
