#pragma once

#include <string>
#include <vector>

#include "analysis/report/diagnosis/html.hpp"

namespace drift::report {

/// Writes a diagnosis into a folder, made if need be: diagnosis.json, residual_signal.csv, the
/// pictures, report.html, study.toml, patched.toml (where a cause is in the model; of an
/// ambiguous verdict the most probable one, said in a comment on top) and advised.toml
/// (the study with the positions of the first advice). Returns the names of the files. A
/// patched.toml or advised.toml of an earlier diagnosis in the same folder that this one does not
/// have is removed. InputError (io) if one cannot be written.
std::vector<std::string> write_results(const mc::Study& study,
                                       const diagnosis::Diagnosis& diagnosis,
                                       const DiagnosisSource& source, const std::string& folder);

}  // namespace drift::report
