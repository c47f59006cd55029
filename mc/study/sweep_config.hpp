#pragma once

#include <string>
#include <vector>

#include "core/config/report.hpp"
#include "mc/study/study.hpp"

namespace drift::mc {

/// Reads [sweep] of a study file, where it has one. What is wrong is in the report: no list, no
/// values or too many of them, a value twice, a key that two lines set.
std::vector<SweepAxis> read_sweep(config::Report& report, const config::Node& root);

/// The keys that the values of a line of [sweep] set: of a table those of its members. Elements of
/// lists are called by their numbers: "filter.0.coupling".
std::vector<std::string> keys_set_by(const config::Member& line, const config::Node& root);

/// Whether a line of [sweep] sets a key: its own, or one of a table that is among its values.
bool sweeps(const config::Node& root, std::string_view key);

}  // namespace drift::mc
