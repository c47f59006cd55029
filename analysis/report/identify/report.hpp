#pragma once

#include "analysis/identification/identify.hpp"
#include "analysis/report/page/report.hpp"

namespace drift::report {

/// All an identification has to say: tables, pictures, identification.json (schema 1) and
/// study.toml, the study with the overrides of the command line; corrected.toml, the study with the
/// headings of the recording, where they are others. InputError (config) as
/// mc::require_own_terms().
Report identification_report(const mc::Study& study, const identification::Identification& id);

/// Writes the report into a folder, what was estimated as tables and as netCDF (results_out.hpp),
/// and recording.csv unless the recording is empty. Returns the names of the files. InputError (io)
/// if one cannot be written.
std::vector<std::string> write_identification(const Report& report,
                                              const identification::Identification& id,
                                              const std::string& folder);

}  // namespace drift::report
