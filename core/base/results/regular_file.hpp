#pragma once

#include <string>

namespace drift {

/// What stands at a path in place of a file: "a directory", "a pipe", "a symbolic link", ...; empty
/// if that is a file, or nothing.
std::string other_than_file(const std::string& path);

/// For a file that driftscope itself keeps, before it is opened: opening a pipe would wait for
/// ever. Nothing there is fine. InputError: store if it is no file; io if it cannot be read.
void require_regular_file_of_ours(const std::string& path);

}  // namespace drift
