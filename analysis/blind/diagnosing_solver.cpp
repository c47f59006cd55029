#include "analysis/blind/diagnosing_solver.hpp"

#include "analysis/diagnosis/diagnose.hpp"

namespace drift::blind {

Solver diagnosing_solver() {
  return [](const std::string& study_path, const std::string& recording_path) {
    const mc::Study study = mc::read_study(study_path);
    const Recording recording = read_recording(recording_path, study.kind, study.site.gravity);
    diagnosis::DiagnoseOptions options;
    options.starts = 0;
    options.signals = false;
    options.whiteness_draws = 0;
    options.folds = diagnosis::FoldMethod::linear;
    return answer_of(diagnosis::diagnose(study, {recording}, options));
  };
}

}  // namespace drift::blind
