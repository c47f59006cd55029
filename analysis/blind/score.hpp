#pragma once

#include <string>
#include <vector>

#include "analysis/blind/answer.hpp"
#include "analysis/blind/trial.hpp"

namespace drift::blind {

/// A recovered number against the true one.
struct Pull {
  std::string key;
  double truth = 0.0, value = 0.0, sigma = 0.0;
  double pull() const { return (value - truth) / sigma; }
};

/// What an answer to one trial is worth.
struct TrialScore {
  KeyEntry key;
  Answer answer;
  bool detected = false;  ///< anything but `consistent`
  bool false_alarm =
      false;  ///< without physics: detected, unless it names the drift's random walk that there is
  bool exact = false;          ///< named, and exactly what was hidden
  bool exact_or_twin = false;  ///< exact, or ambiguous between what is hidden and its exact twins
                               ///< alone (thresholds.hpp)
  bool in_set = false;   ///< named or ambiguous with at most three alternatives, one of them right
  bool offered = false;  ///< as in_set, with any number of alternatives
  bool extra = false;    ///< named, right causes among others
  bool subsystem = false;          ///< the first cause is of a right subsystem
  bool confidently_wrong = false;  ///< named, and no cause is right
  bool unexplained = false;
  bool position_right = false, equation_right = false;  ///< of a local effect
  double overlap = 0.0;                                 ///< of the windows, intersection over union
  bool believed_right = false;  ///< what the diagnosis took for most probable was hidden
  std::vector<Pull> pulls;      ///< of linear parameters, where exact
  std::string
      called;  ///< for the confusion table: term, "several", "unexplained", "consistent", "failed"

  /// The hidden term or the stratum, for the confusion table.
  std::string hidden() const;
  double size() const { return key.effects.empty() ? 0.0 : key.effects.front().size; }
};

TrialScore score_trial(const KeyEntry& key, const Answer& answer);

/// Scores of all trials; an answer that is missing is a failed one. Answers are matched by number.
std::vector<TrialScore> score_trials(const std::vector<KeyEntry>& keys,
                                     const std::vector<Answer>& answers);

}  // namespace drift::blind
