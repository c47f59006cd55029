#include "analysis/blind/belief.hpp"

#include <algorithm>

namespace drift::blind {
namespace {

bool agrees(const diagnosis::NamedEffect& cause, const HiddenEffect& hidden) {
  return cause.term == hidden.term &&
         (cause.axis.empty() || hidden.axis.empty() || cause.axis == hidden.axis);
}

/// Each cause is a hidden effect, and each hidden effect has a cause.
bool same_effects(const std::vector<diagnosis::NamedEffect>& causes,
                  const std::vector<HiddenEffect>& hidden) {
  return std::ranges::all_of(causes,
                             [&](const auto& c) {
                               return std::ranges::any_of(
                                   hidden, [&](const auto& h) { return agrees(c, h); });
                             }) &&
         std::ranges::all_of(hidden, [&](const auto& h) {
           return std::ranges::any_of(causes, [&](const auto& c) { return agrees(c, h); });
         });
}

}  // namespace

Belief belief_of(const diagnosis::Probabilities& p) {
  Belief best;
  if (!p.known()) return best;
  best = {Belief::Kind::consistent, p.consistent, {}};
  if (p.noise_only > best.probability) best = {Belief::Kind::noise_only, p.noise_only, {}};
  for (const diagnosis::Probabilities::Explanation& e : p.named)
    if (e.probability > best.probability) best = {Belief::Kind::named, e.probability, e.causes};
  if (p.outside > best.probability) best = {Belief::Kind::outside, p.outside, {}};
  return best;
}

bool is_right(const Belief& belief, const KeyEntry& key) {
  switch (key.plan.stratum) {
    case Stratum::null:
      return belief.kind == Belief::Kind::consistent;
    case Stratum::wrong_noise:
      return belief.kind == Belief::Kind::noise_only;
    case Stratum::single:
    case Stratum::pair:
    case Stratum::other_equation:
    case Stratum::noisy_single:
    case Stratum::noisy_covariate:
      return belief.kind == Belief::Kind::named && same_effects(belief.causes, key.effects);
    case Stratum::outside:
    case Stratum::local:
      break;
  }
  return belief.kind == Belief::Kind::outside;
}

}  // namespace drift::blind
