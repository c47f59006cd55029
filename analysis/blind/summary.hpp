#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/blind/reliability.hpp"
#include "analysis/blind/score.hpp"
#include "core/stats/proportion.hpp"

namespace drift::blind {

/// How a target stands: decided where the whole interval lies on one side of its bounds.
enum class Standing { met, met_within, missed_within, missed, not_decided };

constexpr std::string_view text(Standing s) {
  switch (s) {
    case Standing::met:
      return "met";
    case Standing::met_within:
      return "met, within its interval";
    case Standing::missed_within:
      return "missed, within its interval";
    case Standing::missed:
      return "missed";
    case Standing::not_decided:
      break;
  }
  return "not decided";
}

/// Fewest trials of which a target is said to be met or missed.
inline constexpr std::size_t fewest_trials = 5;

/// What a target is set for; of single effects of 8 sigma and more where nothing else is said.
enum class Goal {
  looks_healthy,          ///< the nominal fit, where an effect is hidden
  alarm_on_null,          ///< nothing is hidden
  alarm_on_noise,         ///< but noise that is not as declared
  detected_at_8_sigma,    ///< of 8 to 9 sigma
  in_set,                 ///< named exactly, or in a set of at most 3
  right_name,             ///< one name, the right one
  wrong_name,             ///< one name, a wrong one
  pair_in_set,            ///< of two effects: the pair, or a set of at most 3 that holds it
  outside_unexplained,    ///< of effects that are not in the library
  size_within_two_sigma,  ///< of all that was recovered
};

/// A target of the blind study and what was measured.
struct Target {
  Goal goal;
  stats::Proportion measured;
  double low = 0.0, high = 1.0;  ///< the share should lie between
  /// By the share alone.
  bool met() const { return measured.n > 0 && measured.share() >= low && measured.share() <= high; }
  /// With the interval of the share; not decided of fewer than `fewest_trials`.
  Standing standing() const {
    if (measured.n < fewest_trials) return Standing::not_decided;
    if (met())
      return measured.low >= low && measured.high <= high ? Standing::met : Standing::met_within;
    return measured.low <= high && measured.high >= low ? Standing::missed_within
                                                        : Standing::missed;
  }
};

/// Detection at one size or range of sizes.
struct PowerPoint {
  double low = 0.0, high = 0.0, mean = 0.0;  ///< [sigma]
  stats::Proportion detected, exact, in_set, subsystem, wrong;
  double theory = 0.0;  ///< detection of one known signature among `family` of them at 5 %
};

/// How a group of trials went: one plan, one coupling, one stratum, one term.
struct GroupScore {
  std::string name;
  stats::Proportion false_alarms;  ///< on nulls of both kinds
  stats::Proportion detected, exact, in_set, subsystem,
      wrong;  ///< of single effects of 8 sigma and more
};

/// A row of the confusion table: what single effects of one term were called.
struct ConfusionRow {
  std::string hidden;
  std::vector<std::size_t> called;  ///< counts, by column
};

struct Confusion {
  std::vector<std::string> columns;
  std::vector<ConfusionRow> rows;
};

struct Summary {
  std::size_t trials = 0, failed = 0;
  std::vector<Target> targets;
  std::vector<PowerPoint> power;
  std::vector<GroupScore> plans, couplings, modes;
  stats::Proportion concealed;  ///< effect trials with chi-square inside its band
  std::vector<std::pair<std::string, stats::Proportion>> further;  ///< scores without a target
  std::vector<std::pair<std::string, stats::Proportion>> wrong_noise,
      outside;                ///< by kind: false alarms, unexplained
  std::vector<double> pulls;  ///< of all recovered parameters
  Reliability reliability;
  double pull_rms = 0.0;  ///< robust against the few: 1.4826 median |pull|
  Confusion confusion;
  double mean_seconds = 0.0, longest_seconds = 0.0;  ///< per diagnosis
  double largest_bias_median = 0.0;  ///< of the nominal fits of effect trials [sigma]
};

/// Smallest size that "at 8 sigma and above" takes in: sizes are hit within 1 %.
inline constexpr double eight_sigma = 7.9;

Summary summarise(const std::vector<TrialScore>& scores);

}  // namespace drift::blind
