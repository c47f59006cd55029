#include "analysis/blind/source.hpp"

#include <fmt/format.h>

#include "analysis/blind/design.hpp"
#include "analysis/blind/recorded.hpp"
#include "core/base/check.hpp"
#include "core/base/sha256.hpp"
#include "core/config/load.hpp"
#include "core/config/override.hpp"

namespace drift::blind {

void TrialSource::require_usable() const {
  const auto refuse = [&](const std::string& text) {
    throw InputError(ExitCode::config, fmt::format("{}: {}", study_.path, text));
  };
  if (!study_.has_blind)
    refuse("no [blind] (expected which trials to make). Add a section [blind]");
  if (study_.filters.empty())
    refuse("no [[filter]]: a blind study needs a nominal one. Add a section [[filter]]");
  const bool of_case = study_.kind == RecordingKind::strapdown;
  if (recording_ != nullptr && !of_case)
    refuse(
        "effects can be hidden in recordings of a strapdown unit alone (expected plan.kind = "
        "\"strapdown\"). Leave the recording out: trials of a platform are simulated");
  if (recording_ == nullptr && of_case)
    refuse(
        "a strapdown unit is not simulated (expected a recording to hide effects in). Name one "
        "after the study");
  if (of_case) return;
  if (!study_.has_truth) refuse("no [truth] to make recordings from. Add a section [truth]");
  if (study_.plan.preset.empty())
    refuse(
        "[plan] has no preset (expected one, to be replaced by those of blind.plans). Write preset "
        "= \"twelve\"");
}

std::string TrialSource::identity() const {
  if (recording_ == nullptr) return study_.text;
  return fmt::format("{}\n# in {}\n", study_.text, sha256_hex_of_file(recording_->source));
}

std::vector<TrialPlan> TrialSource::plans() const {
  return recording_ == nullptr ? design_trials(study_.blind, study_.monte_carlo.seed)
                               : recorded_trials(study_, *recording_);
}

std::string TrialSource::nominal_text(const TrialPlan& plan) const {
  config::Node root = config::parse_document(study_.text, study_.path);
  std::erase_if(root.members, [&](const config::Member& m) {
    // Whatever the columns of a recording were called, those of a trial have our names.
    return m.key == "truth" || m.key == "blind" || m.key == "monte_carlo" || m.key == "sweep" ||
           m.key == "published" || (m.key == "recording" && recording_ != nullptr);
  });
  apply_override(root, "title", fmt::format("Blind trial {}", plan.number));
  root.find("filter")->items.resize(1);
  if (recording_ != nullptr) return config::to_document(root);
  apply_override(root, "plan.preset", plan.plan);
  apply_override(root, "plan.mode", key_of(plan.mode));
  const Coupling settled = facts(plan.coupling).settles_to;
  apply_override(
      root, "filter.0.coupling",
      key_of(plan.stratum == Stratum::other_equation ? facts(settled).other.value() : settled));
  return config::to_document(root);
}

MadeTrial TrialSource::make(const mc::Study& nominal, const TrialPlan& plan) const {
  return recording_ == nullptr ? make_trial(study_, nominal, plan)
                               : hide_in(*recording_, study_, nominal, plan);
}

}  // namespace drift::blind
