#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "analysis/diagnosis/findings/advice.hpp"
#include "analysis/diagnosis/findings/fit_comparison.hpp"
#include "analysis/diagnosis/findings/not_examined.hpp"
#include "analysis/diagnosis/findings/probabilities.hpp"
#include "analysis/diagnosis/findings/profile.hpp"
#include "analysis/diagnosis/findings/proposal.hpp"
#include "analysis/diagnosis/findings/recovered_signal.hpp"
#include "analysis/diagnosis/findings/remark.hpp"
#include "analysis/diagnosis/findings/twins.hpp"
#include "analysis/diagnosis/findings/verdict.hpp"
#include "analysis/diagnosis/findings/where.hpp"
#include "analysis/identification/field_found.hpp"
#include "analysis/identification/heading_doubt.hpp"
#include "analysis/identification/latitude_doubt.hpp"
#include "analysis/inference/noise/noise_finding.hpp"
#include "analysis/inference/noise/noise_model.hpp"
#include "analysis/search/cause.hpp"
#include "core/base/linalg.hpp"
#include "core/physics/model_spec.hpp"

namespace drift::diagnosis {

/// The best explanation that was not good enough.
struct NearestKnown {
  std::vector<NamedEffect> effects;
  double chi2_per_dof_before = 0.0, chi2_per_dof_after = 0.0;
};

/// How large the errors of prediction of one kind of held-out data are (root mean square).
struct ErrorOfKind {
  std::string what, unit;
  double before = 0.0, after = 0.0;
};

/// All that a diagnosis found: plain data, for the report, the JSON and the scorer.
struct Diagnosis {
  Verdict verdict = Verdict::consistent;
  double p_value = 1.0;  ///< family-wise, over everything that was tried
  Where where;
  std::vector<search::Cause> causes;
  std::vector<search::CandidateScore> candidates;  ///< strongest first
  std::vector<NotExamined> not_examined;
  Probabilities probabilities;
  std::vector<inference::NoiseFinding> noise;
  /// The same, where it drives the platform beyond what is declared.
  std::optional<inference::NoiseModel> driving_noise;
  /// Twice the log evidence that eq. (5) instead of a nominal eq. (6), or the reverse, gains; NaN
  /// where the nominal coupling is neither, and where what is missing has not been found. With the
  /// best explanation in the model, if that is not this very change.
  double other_equation_gain = std::numeric_limits<double>::quiet_NaN();
  FitComparison fit;
  std::vector<Profile> profiles;         ///< of parameters of the causes, where they were asked for
  std::vector<RecoveredSignal> signals;  ///< strongest first; at least one unless consistent
  CosineMatrix cosines;
  std::vector<Twins> inseparable;  ///< what this plan can never tell apart
  std::optional<NearestKnown> nearest_known;
  std::optional<Proposal> proposal;  ///< where it is unexplained and a form was looked for
  std::optional<identification::LatitudeDoubt> site_doubt;
  /// At the latitude of site_doubt, where that is not all: what is missing beside it.
  std::shared_ptr<const Diagnosis> there;
  std::optional<identification::LatitudeDoubt> other_latitude;  ///< would explain it, too
  std::optional<identification::HeadingDoubt> heading_doubt;
  /// Where causes follow a field that had to be assumed: their sigmas hold its error.
  std::optional<identification::FieldFound> field;
  bool of_case = false;               ///< of a recording on a case
  std::vector<int> absent_positions;  ///< numbers of the plan's that no recording holds, ascending
  std::vector<std::string> absent;  ///< channels of [readout] that no recording has; not of a case
  std::vector<ErrorOfKind> errors;  ///< of a recording on a case: what held-out data are missed by
  std::vector<Advice> advice;       ///< most useful first
  std::vector<Remark> remarks;      ///< what a reader must know besides
  FilterSpec nominal;               ///< as fitted
  FilterSpec patched;               ///< with the named (or most probable) cause; for patched.toml
  bool has_patch = false;
  std::vector<std::pair<std::string, double>> seconds;  ///< wall time of each stage

  /// The study is of another place, or of another plan: nothing that is said of causes holds.
  bool wrong_study() const { return site_doubt || heading_doubt; }
};

/// The first remark of a kind, or none.
template <class R>
const R* remark_in(const Diagnosis& d) {
  for (const Remark& r : d.remarks)
    if (const auto* found = std::get_if<R>(&r)) return found;
  return nullptr;
}

}  // namespace drift::diagnosis
