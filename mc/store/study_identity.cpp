#include "mc/store/study_identity.hpp"

#include <algorithm>
#include <string>

#include "core/config/load.hpp"
#include "core/config/node.hpp"
#include "core/config/override.hpp"

namespace drift::mc {
namespace {

/// Brings keys into one order wherever their order means nothing. That of [sweep] numbers the
/// points.
void sort_keys(config::Node& table) {
  std::sort(table.members.begin(), table.members.end(),
            [](const config::Member& a, const config::Member& b) { return a.key < b.key; });
  for (auto& member : table.members) {
    if (member.key == "sweep") continue;
    if (member.value.is(config::Node::Kind::table)) sort_keys(member.value);
    for (auto& item : member.value.items)
      if (item.is(config::Node::Kind::table)) sort_keys(item);
  }
}

}  // namespace

StudyIdentity identity_of(const Study& study) {
  config::Node root = config::parse_document(study.text, study.path);
  // The strata of a Latin hypercube are as many as its runs: it cannot be extended.
  const config::Node* monte_carlo = root.find("monte_carlo");
  const config::Node* design = monte_carlo != nullptr ? monte_carlo->find("design") : nullptr;
  if (design == nullptr || design->text != "latin_hypercube")
    config::apply_override(root, "monte_carlo.runs", "1");
  config::apply_override(root, "monte_carlo.allowed_failures", "0");
  config::apply_override(root, "monte_carlo.seed",
                         std::to_string(study.monte_carlo.seed));  // where it is the default too
  sort_keys(root);
  return {config::to_document(root), study.monte_carlo.seed, StudyIdentity{}.block_size};
}

}  // namespace drift::mc
