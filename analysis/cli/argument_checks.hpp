#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace drift::cli {

// What an argument of the command line must be like. Each returns what is wrong in the grammar
// "problem (expected). What to do", or nothing.

/// A whole number within a range; "-1" is none, whatever unsigned arithmetic makes of it.
std::string check_whole(const std::string& text, std::uint64_t least, std::uint64_t most);

/// Any seed, as a decimal number or "0x...".
std::string check_seed(const std::string& text);

/// One of some names; the nearest is asked about.
std::string check_one_of(const std::string& text, std::span<const std::string_view> names);

/// The name of a file or folder.
std::string check_path(const std::string& text);

/// Anything: a variable of a job script that is not set must not mean that the option was left out.
std::string check_given(const std::string& text);

/// Something that is no file: an option whose value may be left out must not swallow the file
/// behind it.
std::string check_no_file(const std::string& text);

/// The items of "a,b,c"; empty ones are dropped.
std::vector<std::string> list_of(const std::string& text);

/// "unknown command 'runn' (expected one of ...). Did you mean 'run'?"
std::string unknown(std::string_view what, std::string_view given,
                    std::span<const std::string_view> known);

}  // namespace drift::cli
