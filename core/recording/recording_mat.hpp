#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "core/recording/isolated.hpp"
#include "core/recording/recording.hpp"

namespace drift {

/// MATLAB layout (v5 to v7, or v7.3), as Octave writes it with `save -v7 rec.mat` and MATLAB with
/// `save rec.mat`:
///   time = (0.01:0.01:10)';  acc_x = ...;    one numeric column (or row) per channel, no other
///   array units.time = "s";  units.acc_x = "g";    a struct of strings; or time_unit = "s" beside
///   time facts = "sensor = A\nsource = B";        optional: lines "key = value", or a struct of
///   strings
///
/// Reads such a file. Called in a child process (read_isolated), since damaged files can crash the
/// library.
void read_mat(const std::string& path, RawSink& sink);

/// The number of variables of a v5 file by its own tags; empty if they do not end with the file.
/// matio cannot tell the end of a file from a place where it is cut off, and when it writes it does
/// not notice a full disk.
std::optional<std::size_t> count_mat_v5_variables(const std::string& path);

/// Writes such a file (v5, uncompressed), with `facts` instead of the recording's; returns what
/// went wrong, empty if nothing. Called in a child process.
std::string write_mat(const Recording& recording, const Facts& facts, const std::string& path);

}  // namespace drift
