#include "analysis/cli/frozen_study.hpp"

#include <algorithm>

#include "core/base/check.hpp"
#include "core/config/load.hpp"
#include "core/config/node.hpp"
#include "core/config/override.hpp"

namespace drift::cli {
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

mc::StudyIdentity identity_of(const mc::Study& study) {
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
  return {config::to_document(root), study.monte_carlo.seed, mc::StudyIdentity{}.block_size};
}

mc::Study frozen_study(const std::string& folder, const mc::StudyReader& reader) {
  const std::string path = folder + "/study.toml";
  const auto mismatch = [&](const std::string& why) {
    return InputError(
        ExitCode::store,
        fmt::format("{}: {} (expected the study that the folder was made with). Restore it: "
                    "the value of \"study\" in manifest.json",
                    path, why));
  };
  const std::uint64_t runs = std::max<std::uint64_t>(reader.runs(), 1);
  try {
    mc::Study study = mc::read_study(path, {{"monte_carlo.runs", std::to_string(runs)}});
    mc::StudyIdentity identity = identity_of(study);
    identity.block_size = reader.manifest().identity.block_size;
    if (identity.hash() == reader.manifest().hash) return study;
  } catch (const InputError& error) {
    throw mismatch(error.messages().front());
  }
  throw mismatch("changed since");
}

}  // namespace drift::cli
