#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace drift {

/// The whole of a file, byte by byte; none if it cannot be opened. InputError (io) if it cannot be
/// read to its end.
std::optional<std::string> file_text(const std::filesystem::path& path);

/// InputError (io) "path: cannot be read: reason. What to do".
[[noreturn]] void throw_cannot_read(const std::string& path, const std::string& reason);

}  // namespace drift
