#pragma once

#include <string>
#include <string_view>

namespace drift::report {

/// Text as the content or a quoted attribute value of XML and HTML. Control characters, which XML
/// cannot hold, and bytes that are not UTF-8 become U+FFFD.
std::string escaped(std::string_view text);

/// Columns that UTF-8 text takes on a terminal, one per character.
std::size_t display_width(std::string_view text);

/// Text as part of a file name: letters, digits, '-', '_', '.'; anything else becomes '_'. Never
/// empty, never starting with a dot, at most 64 characters.
std::string file_name_part(std::string_view text);

}  // namespace drift::report
