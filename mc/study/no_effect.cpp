#include "mc/study/no_effect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/base/words.hpp"
#include "core/config/override.hpp"

namespace drift::mc {
namespace {

using config::Node;

/// What stands under a dotted key; null if nothing does.
const Node* node_at(const Node& root, std::string_view key) {
  const Node* at = &root;
  while (at != nullptr && !key.empty()) {
    const std::string part(key.substr(0, key.find('.')));
    key.remove_prefix(std::min(key.size(), part.size() + 1));
    if (!at->is(Node::Kind::array)) {
      at = at->find(part);
      continue;
    }
    const auto number = std::ranges::find_if(
        at->items, [&, k = 0](const Node&) mutable { return std::to_string(k++) == part; });
    at = number == at->items.end() ? nullptr : &*number;
  }
  return at;
}

/// The model that a table of parameters is of: "truth.parameters", "filter.0.parameters",
/// "truth.loop".
const ModelSpec* model_of(const Study& study, std::string_view table) {
  if (table == "truth.parameters" || table == "truth.loop") return &study.truth;
  for (std::size_t f = 0; f < study.filters.size(); ++f)
    if (table == fmt::format("filter.{}.parameters", f)) return &study.filters[f];
  return nullptr;
}

/// A group ("truth.parameters.eta") all of whose members have values of their own.
std::optional<NoEffect> of_group(const Node& root, const Study& study, std::string_view key) {
  const std::size_t dot = key.rfind('.');
  if (dot == std::string_view::npos) return std::nullopt;
  const std::string_view table = key.substr(0, dot), group = key.substr(dot + 1);
  const ModelSpec* model = model_of(study, table);
  const Node* values = node_at(root, table);
  if (model == nullptr || values == nullptr || TermLibrary::find(group)) return std::nullopt;
  std::vector<std::string> members;
  for (std::size_t i = 0; i < TermLibrary::specs.size(); ++i) {
    const ParamSpec& spec = TermLibrary::specs[i];
    if (spec.group.view() != group || (table != "truth.loop" && !model->active[i])) continue;
    if (values->find(spec.key.view()) == nullptr) return std::nullopt;
    members.emplace_back(spec.key.view());
  }
  if (members.empty()) return std::nullopt;
  const bool one = members.size() == 1;
  return NoEffect{
      fmt::format("{} {} own", listed(members, "and"),
                  one ? "has a value of its" : "have values of their"),
      one ? "Name it instead, or remove its value" : "Name them instead, or remove their values"};
}

/// A key of [plan] that every position has for itself.
std::optional<NoEffect> of_positions(const Node& root, std::string_view key) {
  constexpr std::string_view plan = "plan.";
  constexpr std::string_view keys[] = {"dwell", "sample", "mode", "entry"};
  if (!key.starts_with(plan)) return std::nullopt;
  const std::string own(key.substr(plan.size()));
  const Node* positions = node_at(root, "plan.position");
  if (std::ranges::find(keys, own) == std::end(keys) || positions == nullptr ||
      !positions->is(Node::Kind::array) || positions->items.empty())
    return std::nullopt;
  const bool first_is_caged = own == "entry";  // whatever is said
  const auto begin = positions->items.begin() + (first_is_caged ? 1 : 0);
  if (!std::all_of(begin, positions->items.end(),
                   [&](const Node& position) { return position.find(own) != nullptr; }))
    return std::nullopt;
  if (begin == positions->items.end())
    return NoEffect{"the only position is caged", "Leave it out"};
  return NoEffect{fmt::format("every position {}has {} {} of its own",
                              first_is_caged ? "behind the first, which is caged, " : "",
                              first_is_caged ? "an" : "a", own),
                  fmt::format("Name that of a position (plan.position.{}.{}), or remove it from "
                              "the positions",
                              first_is_caged ? 1 : 0, own)};
}

/// The noise of what is not read, rates of slews and turns where there are none.
std::optional<NoEffect> of_what_is_not_there(const Study& study, std::string_view key) {
  const auto unread = [](std::string_view instruments) {
    return NoEffect{
        fmt::format("{} are not read", instruments),
        fmt::format("Set readout.{} = true, or leave out what is of them", instruments)};
  };
  if (key == "readout.accelerometer_noise" && !study.readout.accelerometers)
    return unread("accelerometers");
  if (key == "readout.gimbal_noise" && !study.readout.gimbals) return unread("gimbals");
  const bool rate = key == "plan.slew_rate" || key == "plan.case_rate";
  const auto is_torqued = [](const Position& p) { return p.entry == Entry::torqued; };
  if (rate && study.kind == RecordingKind::platform &&
      std::ranges::none_of(study.plan.positions, is_torqued))
    return NoEffect{"no position is entered torqued, and caged ones are entered without a way",
                    "Let a position have entry = \"torqued\", or leave it out"};
  return std::nullopt;
}

}  // namespace

std::optional<NoEffect> no_effect(const Node& root, const Study& study, const std::string& key) {
  if (auto group = of_group(root, study, key)) return group;
  if (auto positions = of_positions(root, key)) return positions;
  return of_what_is_not_there(study, key);
}

}  // namespace drift::mc
