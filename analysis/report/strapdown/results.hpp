#pragma once

#include <string>
#include <vector>

#include "analysis/strapdown/identify.hpp"
#include "mc/study/study.hpp"

namespace drift::report {

/// Writes the results of a strapdown recording into a folder: identification.json, rotations.svg
/// (the held-out error of every model tried), report.html and study.toml. Returns the names of the
/// files.
std::vector<std::string> write_results(const mc::Study& study,
                                       const strapdown::StrapdownResult& result,
                                       const std::string& folder);

}  // namespace drift::report
