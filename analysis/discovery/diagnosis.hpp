#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "analysis/discovery/advice.hpp"
#include "core/base/linalg.hpp"
#include "core/physics/model_spec.hpp"

namespace drift::discovery {

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

/// A part of the misfit that the nominal model leaves: `share` of the strongest location's T falls
/// on it; shares of all parts sum to 1. z: studentised excess of its mean square over 1.
struct Share {
  std::string name;  ///< "acc_y", "gimbal_middle"; empty for positions
  int position = 0;  ///< 1-based; 0 for channels
  double share = 0.0, sigma = 0.0;
  double chi2_per_dof = 1.0, z = 0.0;
};

/// One cell of the heat map channel x position.
struct HeatCell {
  int position = 0;    ///< 1-based
  int channel = 0;     ///< index into Where::channel_names
  double share = 0.0;  ///< part of the located misfit, signed as its sum
  double chi2_per_dof = 1.0;
};

/// Outcome of one window of the location scan: a unit box in one equation, position and window.
struct ScanHit {
  std::string
      equation;      ///< "platform rate y", "attitude offset y", "accelerometer x", "gimbal outer"
  int position = 0;  ///< 1-based
  double start_s = 0.0, end_s = 0.0;
  double T = 0.0;                       ///< projected score, chi-square of one degree
  double p_value = 1.0;                 ///< family-wise over the scan
  double amplitude = 0.0, sigma = 0.0;  ///< of the box [rad/s, rad, g, rad by equation]
};

/// Where one of several recordings lies in the timeline that they make one after another.
struct RecordingSpan {
  std::string name;
  double start_s = 0.0, end_s = 0.0;
  double offset_s = 0.0;  ///< time of the timeline less the recording's own
};

struct Where {
  std::vector<std::string> channel_names;  ///< acc_x y z, gimbal_outer middle inner
  std::vector<Share> channels, positions;  ///< largest share first
  std::vector<HeatCell> heat;
  std::vector<ScanHit> windows;  ///< significant ones, strongest first; overlapping ones once
  std::string equation;          ///< of the strongest, empty if nothing is significant
  double scan_p_value = 1.0;     ///< family-wise over all windows
  std::size_t windows_tried = 0;
  std::vector<RecordingSpan> recordings;  ///< in order, of several; empty of one
};

/// A number of a cause, in `unit`.
struct CauseParameter {
  std::string key;
  std::size_t param = 0;  ///< index in TermLibrary
  double value = 0.0, sigma = 0.0;
  std::string unit;
  bool profiled = false;  ///< nonlinear: found on a grid and refined; sigma from the profile
};

struct Confusable {
  std::string term, axis;
  double cosine = 0.0;  ///< of the two projected signatures
};

/// One cause in the answer.
struct Cause {
  std::string term;  ///< key of interfaces.md 5, "magnetic_drift"
  std::string axis;  ///< "y", empty if it has none or is not split
  std::vector<CauseParameter> parameters;
  double T = 0.0;  ///< projected score of `dof` degrees
  int dof = 1;
  double p_value =
      1.0;  ///< family-wise; of several simultaneous causes each with the others in the model
  double held_out_gain =
      std::numeric_limits<double>::quiet_NaN();  ///< log score that its absence costs; of
                                                 ///< simultaneous causes
  double probability = 0.0;
  double size_sigma = 0.0;  ///< size needed, in prior sigmas
  int set = 0;  ///< simultaneous causes share a number; alternatives have different ones
  std::vector<Confusable> confusable_with;
};

/// A candidate's line in the table: every one that was tried.
struct CandidateScore {
  std::string term, axis, label;
  int dof = 1;
  double score = 0.0;       ///< T
  double p_value = 1.0;     ///< family-wise
  double p_marginal = 1.0;  ///< of this candidate alone
  double absorbed = 0.0;    ///< part of the raw signature that fitted parameters take up, 0..1
  double amplitude = 0.0,
         sigma = 0.0;  ///< expected parameter change and its sigma, in `unit` (one degree)
  double smallest_detectable = 0.0;  ///< amplitude found with 80 % probability, in `unit`
  double size_sigma = 0.0;           ///< amplitude over prior sigma
  double log_bayes = 0.0;            ///< log evidence against the nominal model
  double probability = 0.0;          ///< among all single candidates and nothing
  double worst_conditional = 0.0;    ///< largest p-equivalent T of others once this one is in
  bool adequate = false;             ///< nothing else is significant once it is in
  bool observable = true;
  std::string unit;
};

/// Noise that is not as declared (interfaces.md 5).
struct NoiseFinding {
  std::string component;  ///< gimbal_white, accelerometer_white, angle_random_walk,
                          ///< drift_random_walk, markov_drift, accelerometer_markov, outliers
  double factor = 1.0;    ///< estimated over declared sigma (white); NaN where nothing was declared
  double factor_sigma = 0.0;
  double value = 0.0;  ///< 1 sigma in `unit`
  std::string unit;
  double tau_s = 0.0;  ///< Markov and correlated noise [s]
  double log_likelihood_gain = 0.0;
  double p_value = 1.0;
  bool significant = false;
  std::size_t count = 0;  ///< outliers: samples left out
};

struct ShiftedParameter {
  std::string key, unit;
  std::size_t param = 0;
  double before = 0.0, sigma_before = 0.0, after = 0.0, sigma_after = 0.0;  ///< in `unit`
  double shift_sigma = 0.0;  ///< (after - before) / sigma_before
};

/// Held-out prediction of one fold.
struct Fold {
  std::string name;            ///< "position 3"
  std::vector<int> positions;  ///< 1-based
  double chi2_before = 0.0, chi2_after = 0.0;
  std::size_t dof = 0;
  double log_score_before = 0.0, log_score_after = 0.0;  ///< log predictive density
  bool same_choice = true;  ///< the other positions alone would have chosen the same cause
};

struct HeldOut {
  std::vector<Fold> folds;
  double chi2_per_dof_before = 0.0, chi2_per_dof_after = 0.0;
  double log_score_gain = 0.0, log_score_gain_sigma = 0.0;
  double nested_gain = 0.0;  ///< with the cause chosen anew in every fold
  bool improves = false;     ///< the condition for keeping a term
  std::string method;        ///< "refitted" or "linear"
  /// Where several recordings are given: each predicted from a fit to the others.
  std::vector<Fold> recordings;
  double recording_chi2_per_dof_before = 0.0, recording_chi2_per_dof_after = 0.0;
  double recording_gain = 0.0;
};

struct Whiteness {
  double ljung_box_p_before = 1.0,
         ljung_box_p_after = 1.0;  ///< calibrated by simulation (whiteness.hpp)
  double nis_per_dof_before = 1.0, nis_per_dof_after = 1.0;
};

/// Before and after the cause is in the model.
struct FitComparison {
  double chi2_before = 0.0, chi2_after = 0.0;
  double chi2_per_dof_before = 1.0, chi2_per_dof_after = 1.0;
  double band_low = 0.0, band_high = 0.0;  ///< 95 % of chi2 per dof
  std::size_t dof = 0;
  double log_likelihood_ratio =
      0.0;                ///< 2 d log L of the nonlinear refit, under the noise of the second model
  double linear_T = 0.0;  ///< what the score predicted, under the same noise
  bool sign_agrees = true;  ///< of the predicted and the refitted amplitude
  Whiteness whiteness;
  double start_spread_before = 0.0, start_spread_after = 0.0;  ///< largest start-consistency ratio
  std::vector<ShiftedParameter> shifted;                       ///< largest first
  HeldOut held_out;
  // Residuals in declared sigmas, one per interval, NaN where not measured.
  // Rows as Where::channel_names.
  Eigen::Matrix<double, 6, Eigen::Dynamic> residual_before, residual_after;
  std::vector<double> residual_t;  ///< [s], one per column; empty: as the first recovered signal
};

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
  std::vector<Cause> causes;
  std::vector<CandidateScore> candidates;  ///< strongest first
  std::vector<NoiseFinding> noise;
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

}  // namespace drift::discovery
