#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/identify.hpp"

namespace drift {

/// Writes a text file complete or not at all. InputError (io) with path and reason, a full disk
/// included; the target is then as it was.
void write_text_atomically(const std::string& path, std::string_view text);

/// Writes the results into a folder, made if need be: identification.json, the pictures,
/// report.html, recording.csv (unless the recording is empty) and study.toml, the study file as it
/// was read from. Returns the names of the files. InputError (io) if one cannot be written.
std::vector<std::string> write_results(const Study& study, const Identification& id,
                                       const std::string& folder);

}  // namespace drift
