#include "analysis/planning/study_with_positions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "analysis/planning/position_toml.hpp"
#include "core/base/check.hpp"
#include "core/config/load.hpp"
#include "mc/study/sweep_config.hpp"

namespace drift::planning {
namespace {

using config::Member;
using config::Node;

/// Keys of [plan] that positions written out do without.
constexpr std::array<std::string_view, 6> of_positions = {"preset", "position", "dwell",
                                                          "sample", "mode",     "entry"};

bool sets_positions(const Member& line) {
  Node sweep, alone;
  sweep.members.push_back(line);
  alone.members.push_back({"sweep", {}, std::move(sweep)});
  return std::ranges::any_of(of_positions, [&](std::string_view key) {
    return mc::sweeps(alone, fmt::format("plan.{}", key));
  });
}

Node parsed(const mc::Study& study) {
  return config::parse_document(study.text, study.path);
}

void drop_swept_of_plan(Node& root) {
  Node* sweep = root.find("sweep");
  if (sweep == nullptr || std::erase_if(sweep->members, sets_positions) == 0) return;
  if (sweep->members.empty())
    std::erase_if(root.members, [](const Member& m) { return m.key == "sweep"; });
}

}  // namespace

std::string study_with_positions(const mc::Study& study, const std::vector<Position>& positions) {
  Node root = parsed(study);
  Node* plan = root.find("plan");
  DRIFT_DEMAND(plan != nullptr);  // no study is read without
  std::erase_if(plan->members, [](const Member& m) {
    return std::ranges::find(of_positions, m.key) != of_positions.end();
  });
  Node list = config::list_node({});
  for (const Position& p : positions) list.items.push_back(position_node(p));
  plan->members.push_back({"position", {}, std::move(list)});
  drop_swept_of_plan(root);
  return config::to_document(root);
}

std::string extended_study(const mc::Study& study, const std::vector<Position>& positions) {
  if (study.kind != RecordingKind::platform)
    throw InputError(ExitCode::config,
                     fmt::format("{}: a strapdown plan has no positions to add to "
                                 "(expected a platform plan). Record more turns",
                                 study.path));
  std::vector<Position> all = study.plan.positions;
  all.insert(all.end(), positions.begin(), positions.end());
  return study_with_positions(study, all);
}

std::vector<std::string> swept_of_plan(const mc::Study& study) {
  std::vector<std::string> keys;
  if (study.sweep.empty()) return keys;
  const Node root = parsed(study);
  if (const Node* sweep = root.find("sweep"))
    for (const Member& line : sweep->members)
      if (sets_positions(line)) keys.push_back(line.key);
  return keys;
}

}  // namespace drift::planning
