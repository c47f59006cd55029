#pragma once

#include "analysis/blind/generate.hpp"

namespace drift::blind {

/// What the trials of a blind study are made of: the study alone, which has a truth, or a recording
/// that effects are hidden in. Both outlive it.
class TrialSource {
 public:
  TrialSource(const mc::Study& study, const Recording* hidden_in = nullptr)  // NOLINT: is a source
      : study_(study), recording_(hidden_in) {}

  const mc::Study& study() const { return study_; }
  /// InputError (config) if the study cannot be made trials of.
  void require_usable() const;
  /// All that the trials depend on beside the program.
  std::string identity() const;
  std::vector<TrialPlan> plans() const;
  /// What the solver gets of the study: no truth, no [blind], no seed; of simulated trials with
  /// preset, mode and coupling of the trial. TOML text that read_study() takes.
  std::string nominal_text(const TrialPlan& plan) const;
  /// nominal: the same, read back.
  MadeTrial make(const mc::Study& nominal, const TrialPlan& plan) const;

 private:
  const mc::Study& study_;
  const Recording* recording_;
};

}  // namespace drift::blind
