#pragma once

#include <string>
#include <vector>

#include "core/config/report.hpp"
#include "mc/study/study.hpp"

namespace drift::mc {

/// Reads [sweep] (null: none). What is wrong is in the report: no list, no values or too many of
/// them, a value twice, a key that two lines set.
std::vector<SweepAxis> read_sweep(config::Report& report, const config::Node* sweep);

/// Whether a line of [sweep] sets a key: its own, or one of a table that is among its values.
bool sweeps(const config::Node* sweep, std::string_view key);

}  // namespace drift::mc
