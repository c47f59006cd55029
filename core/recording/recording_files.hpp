#pragma once

#include <string>

#include "core/recording/recording_problems.hpp"
#include "core/recording/recording_raw.hpp"

namespace drift {

/// The extension of a path in lower case, with its dot.
std::string extension_of(const std::string& path);

/// Whether a file is one of text in columns, whatever separates them, by its extension.
bool is_text_file(const std::string& path);

/// Whether it is one of columns of numbers that have names: HDF5, MATLAB.
bool is_binary_file(const std::string& path);

/// The columns of such a file, as they stand in it; what is wrong is added to `problems`.
/// InputError (io).
RawRecording read_binary(const std::string& path, Problems& problems);

}  // namespace drift
