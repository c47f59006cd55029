#include "mc/study/study_notes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/config/load.hpp"
#include "core/config/override.hpp"
#include "mc/study/no_effect.hpp"
#include "mc/study/sweep_config.hpp"

namespace drift::mc {
namespace {

using config::Node;

std::string_view section_of(std::string_view key) {
  return key.substr(0, key.find('.'));
}

/// The keys that lines of [sweep] with several values set.
std::vector<std::string> varied_keys(const Node& root) {
  std::vector<std::string> all;
  if (const Node* sweep = root.find("sweep"))
    for (const config::Member& line : sweep->members)
      if (line.value.items.size() > 1)
        for (std::string& key : keys_set_by(line, root)) all.push_back(std::move(key));
  return all;
}

bool is_sample_interval(std::string_view key) {
  return key == "plan.sample" || (key.starts_with("plan.position.") && key.ends_with(".sample"));
}

bool is_readout_noise(std::string_view key) {
  return key == "readout.accelerometer_noise" || key == "readout.gimbal_noise";
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

std::string swept_sample_text(const Study& study) {
  if (study.sweep.empty()) return "";
  const std::vector<std::string> keys = varied_keys(config::parse_document(study.text, study.path));
  const auto sample = std::ranges::find_if(keys, is_sample_interval);
  if (sample == keys.end() || std::ranges::any_of(keys, is_readout_noise)) return "";
  return fmt::format(
      "note: {} is swept, the noise of [readout] is not: a sample has it however long it is "
      "(accelerometers: in the mean over it, gimbals: in one reading), so the points compare noise "
      "rather than sampling. White noise is less in a longer mean, by the root of the time: "
      "compare "
      "studies of which each has its own accelerometer_noise\n",
      *sample);
}

}  // namespace drift::mc
