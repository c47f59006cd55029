#pragma once

#include <span>

#include "analysis/diagnosis/findings/diagnosis.hpp"
#include "analysis/diagnosis/held_out/held_out.hpp"
#include "analysis/diagnosis/located.hpp"
#include "analysis/diagnosis/profiles.hpp"
#include "analysis/diagnosis/stages.hpp"
#include "analysis/search/search.hpp"
#include "mc/study/study.hpp"

namespace drift::diagnosis {

/// Whether a form is looked for where nothing known explains a misfit (proposal/propose.hpp). It
/// takes places of the process's own terms meanwhile: not while other threads diagnose.
enum class Proposing { left_out, where_unexplained };

/// How much a diagnosis does.
struct DiagnoseOptions {
  search::SearchOptions search;
  FoldMethod folds = FoldMethod::refitted;
  int starts = 3;  ///< fits for the start spread, prior mean and drawn; below 2: none
  Signals signals = Signals::recovered;  ///< the missing input as a time series
  int whiteness_draws = 399;  ///< of the null distribution of the whiteness test; 0: not tested
  int threads = 0;            ///< 0: all; what is found does not depend on it
  StageReport progress;
  NamedBy named_by = NamedBy::held_out;
  Proposing proposing = Proposing::left_out;
  Profiles profiles = Profiles::left_out;
};

/// Compares recordings with the study's first filter (the nominal model): is there missing physics,
/// where, what, how large, and does putting it in predict positions it has not seen? Several
/// recordings are taken as one test. A pure function of study and recordings.
/// InputError (config) without a filter; InputError (recording) if nothing was measured.
Diagnosis diagnose(const mc::Study& study, const std::vector<Recording>& recordings,
                   const DiagnoseOptions& options = {});

/// The same on a test that is laid out already. starts: initial estimates of the nominal filter
/// beside its prior means. recording_ends: interval behind the last of each recording, if several.
Diagnosis diagnose(const FilterSpec& nominal, const MeasuredTest& test,
                   std::span<const Theta> starts,
                   const std::vector<preparation::Covariate>& covariates,
                   const DiagnoseOptions& options = {},
                   const std::vector<std::size_t>& recording_ends = {});

}  // namespace drift::diagnosis
