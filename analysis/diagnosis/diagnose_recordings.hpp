#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/diagnosis/diagnose.hpp"
#include "core/recording/recording.hpp"

namespace drift::diagnosis {

/// Whether further positions are proposed.
enum class Advising {
  left_out,
  where_needed,  ///< where the verdict needs it
  on_request,    ///< of the terms asked for; of none: what the verdict suggests
};

/// What a diagnosis of recordings does.
struct RecordingsOptions {
  DiagnoseOptions diagnose;
  Advising advising = Advising::where_needed;
  std::vector<std::string> asked;  ///< terms to be told apart, on request
};

/// A diagnosis from a study and recordings as they come: the one entrance, for `diagnose`, `blind`
/// and the tests.
///
/// They are looked over (prepare()), the nominal model is compared with them (diagnose()), the
/// headings, the latitude and the times are doubted where they may be behind it (heading_doubt(),
/// site_doubt(), times_instead()), and positions are proposed that would tell more (advise()). A
/// pure function of its arguments but for `seconds`. InputError as those throw; advice that cannot
/// be made is a remark and never costs the diagnosis.
Diagnosis diagnose_recordings(const mc::Study& study, const std::vector<Recording>& recordings,
                              const RecordingsOptions& options = {});

/// Nothing is said of causes, forms and shapes, and no probabilities, at a latitude, or with
/// headings, that are not the recording's.
Diagnosis of_another_study(Diagnosis diagnosis);

}  // namespace drift::diagnosis
