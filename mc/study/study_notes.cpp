#include "mc/study/study_notes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/config/load.hpp"
#include "core/config/override.hpp"
#include "mc/study/no_effect.hpp"

namespace drift::mc {
namespace {

using config::Node;

std::string_view section_of(std::string_view key) {
  return key.substr(0, key.find('.'));
}

}  // namespace

std::string idle_settings_text(const Study& study) {
  if (study.overrides.empty()) return "";
  const Node root = config::parse_document(study.text, study.path);
  std::string text;
  for (const auto& override : study.overrides) {
    const std::string& key = override.first;
    const bool is_swept = std::ranges::any_of(study.sweep, [&](const SweepAxis& axis) {
      return section_of(axis.key) == section_of(key);
    });
    if (is_swept) continue;
    if (const auto why = no_effect(root, study, config::numbered(root, key)))
      text +=
          fmt::format("note: --set {} changes nothing: {}. {}\n", key, why->why, why->what_to_do);
  }
  return text;
}

}  // namespace drift::mc
