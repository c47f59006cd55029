#pragma once

#include <string>
#include <string_view>

#include "core/config/node.hpp"

namespace drift::config {

/// Contents of a configuration file. InputError (config) if it cannot be opened or read, is a
/// directory, pipe or device (never blocks), is larger than 4 MiB, or is not UTF-8 text.
std::string load_text(const std::string& path);

/// Parses TOML. `name` is what messages call the file. InputError (config) at the first syntax
/// error, with line and column; also for keys or values nested deeper than any study is.
Node parse_document(std::string_view text, const std::string& name);

/// Parses one TOML value, as given to --set; what is none (`10 min`, `eq6`) is taken as a string.
/// InputError (config) if it starts like a list, table or quoted string but is broken.
Node parse_value(std::string_view text, const std::string& set_key);

}  // namespace drift::config
