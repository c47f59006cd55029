#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "analysis/diagnosis/advice.hpp"
#include "analysis/diagnosis/fit_comparison.hpp"
#include "analysis/diagnosis/where.hpp"
#include "analysis/inference/noise_finding.hpp"
#include "analysis/search/cause.hpp"
#include "core/base/linalg.hpp"
#include "core/physics/model_spec.hpp"

namespace drift::diagnosis {

/// What a diagnosis ends with (interfaces.md 6).
enum class Verdict { consistent, named, ambiguous, unexplained };

constexpr std::string_view text(Verdict v) {
  switch (v) {
    case Verdict::consistent:
      return "consistent";
    case Verdict::named:
      return "named";
    case Verdict::ambiguous:
      return "ambiguous";
    case Verdict::unexplained:
      break;
  }
  return "unexplained";
}

/// The missing input as a time series with its band: a platform rate or a channel error.
struct RecoveredSignal {
  std::string equation;              ///< "platform rate y"
  std::string unit;                  ///< "deg/h", "arcsec", "ug"
  std::vector<double> t;             ///< [s], interval ends
  std::vector<int> position;         ///< 1-based
  std::vector<double> value, sigma;  ///< in `unit`
  std::vector<double> explained;  ///< the winner's signature, projected alike; empty without winner
  std::string shape;  ///< plain description: axis, onset, period, what it correlates with
  double onset_s = -1.0, period_s = -1.0;
  std::string best_covariate;
  double correlation = 0.0;
};

/// Cosines between the projected signatures of the causes in question.
struct CosineMatrix {
  std::vector<std::string> labels;
  MatX cosine;
};

/// Odds of e^4.5 either way: below, neither of eq. (5) and (6) is ruled out.
inline constexpr double equation_told = 9.0;

/// All that a diagnosis found: plain data, for the report, the JSON and the scorer.
struct Diagnosis {
  Verdict verdict = Verdict::consistent;
  double p_value = 1.0;  ///< family-wise, over everything that was tried
  std::string sentence;  ///< the verdict in one sentence for a test engineer
  Where where;
  std::vector<search::Cause> causes;
  std::vector<search::CandidateScore> candidates;  ///< strongest first
  std::vector<inference::NoiseFinding> noise;
  /// Twice the log evidence that eq. (5) instead of a nominal eq. (6), or the reverse, gains; NaN
  /// where the nominal coupling is neither.
  double other_equation_gain = std::numeric_limits<double>::quiet_NaN();
  FitComparison fit;
  std::vector<RecoveredSignal> signals;  ///< strongest first; at least one unless consistent
  CosineMatrix cosines;
  std::vector<Advice> advice;            ///< most useful first
  std::vector<std::string> inseparable;  ///< groups this plan can never tell apart, in words
  std::vector<std::string>
      remarks;         ///< what a reader must know (left-out channels, priors hit, ...)
  FilterSpec nominal;  ///< as fitted
  FilterSpec patched;  ///< with the named (or most probable) cause; for patched.toml
  bool has_patch = false;
  std::vector<std::pair<std::string, double>> seconds;  ///< wall time of each stage
};

}  // namespace drift::diagnosis
