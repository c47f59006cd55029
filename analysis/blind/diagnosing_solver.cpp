#include "analysis/blind/diagnosing_solver.hpp"

#include "analysis/diagnosis/diagnose.hpp"

namespace drift::blind {

Solver diagnosing_solver() {
  return [](const std::string& study_path, const std::string& recording_path) {
    const Study study = read_study(study_path);
    const Recording recording = read_recording(recording_path, study.kind, study.site.gravity);
    discovery::DiagnoseOptions options;
    options.starts = 0;
    options.signals = false;
    options.whiteness_draws = 0;
    options.folds = discovery::FoldMethod::linear;
    return answer_of(discovery::diagnose(study, {recording}, options));
  };
}

}  // namespace drift::blind
