#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace drift {

/// Bytes of the well-formed UTF-8 character that a text begins with (no surrogates, no overlong
/// forms); 0 if there is none.
std::size_t utf8_character(std::string_view text);

/// Whether the bytes are UTF-8.
bool valid_utf8(std::string_view text);

/// Bytes from outside (names of files, arguments) as UTF-8: what is none becomes \xNN. For texts
/// that others read: JSON, facts, reports.
std::string utf8_text(std::string_view bytes);

/// The same, fit for a terminal: also what would steer it or hide text on it (control characters
/// but line ends and tabs, directions of writing) becomes \xNN or \uNNNN.
std::string terminal_text(std::string_view bytes);

/// The name of a file within a message of one line: all control characters as \xNN, line ends and
/// tabs too.
std::string text_of_name(std::string_view name);

/// Every line of a text at most `longest` bytes long: the middle of a longer one is left out, and
/// said how much.
std::string shortened_lines(std::string_view text, std::size_t longest);

}  // namespace drift
