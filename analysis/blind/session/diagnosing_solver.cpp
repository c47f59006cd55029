#include "analysis/blind/session/diagnosing_solver.hpp"

#include "analysis/diagnosis/diagnose_recordings.hpp"
#include "analysis/strapdown/case_diagnose.hpp"

namespace drift::blind {

Solver diagnosing_solver() {
  return [](const std::string& study_path, const std::string& recording_path) {
    const mc::Study study = mc::read_study(study_path);
    const Recording recording =
        read_recording(recording_path, study.recording, study.kind, study.site.gravity);
    diagnosis::RecordingsOptions options;
    options.advising =
        diagnosis::Advising::left_out;     // comes after the verdict and has no part in it
    options.diagnose.whiteness_draws = 0;  // neither has this
    if (study.kind == RecordingKind::strapdown)
      return answer_of(strapdown::diagnose_case(study, strapdown::identify_case(study, recording),
                                                options.diagnose));
    return answer_of(diagnosis::diagnose_recordings(study, {recording}, options));
  };
}

}  // namespace drift::blind
