#pragma once

#include <string>
#include <vector>

#include "core/base/linalg.hpp"

namespace drift::diagnosis {

struct ShiftedParameter {
  std::string key, unit;
  std::size_t param = 0;
  double before = 0.0, sigma_before = 0.0, after = 0.0, sigma_after = 0.0;  ///< in `unit`
  double shift_sigma = 0.0;  ///< (after - before) / sigma_before
};

/// Held-out prediction of one fold.
struct Fold {
  enum class Of { position, recording, dwell };
  Of of = Of::position;        ///< what is held out
  int number = 0;              ///< of it, 1-based
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
  /// They are predicted no better though positions are: what was found may be in one of them only.
  bool recordings_disagree = false;
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

}  // namespace drift::diagnosis
