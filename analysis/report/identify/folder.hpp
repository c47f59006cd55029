#pragma once

#include <string>
#include <vector>

#include "analysis/identification/identify.hpp"

namespace drift::report {

/// Writes the results into a folder, made if need be: identification.json, the pictures,
/// report.html, recording.csv (unless the recording is empty) and study.toml, the study with the
/// overrides of the command line. Returns the names of the files. InputError (io) if one cannot be
/// written.
std::vector<std::string> write_results(const mc::Study& study,
                                       const identification::Identification& id,
                                       const std::string& folder);

}  // namespace drift::report
