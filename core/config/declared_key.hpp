#pragma once

#include <string>
#include <vector>

#include "core/config/option.hpp"

namespace drift::config {

/// A key that a reader of sections asked for, and what it takes: for schemas, completion,
/// documents.
struct DeclaredKey {
  enum class Kind {
    unknown,   ///< asked for, but nobody has said for what
    section,   ///< keys that are declared in turn
    sections,  ///< a list of sections, [[...]]
    table,     ///< keys of the user's own, or parameters
    list,
    list_or_table,
    choice,
    truth_value,
    whole,     ///< a whole number
    number,    ///< without unit
    quantity,  ///< a number with a unit
    vector,    ///< three values
    matrix,    ///< three rows of three values
    text,
    text_or_list,  ///< a text, or a list of texts
  };
  std::string section;  ///< "plan.position.0"; of the whole file empty
  std::string key;
  Kind kind = Kind::unknown;
  std::string expected = {};              ///< in the words of messages: what may stand there
  Option option = {};                     ///< unit, least and most of a number; its key is empty
  std::vector<std::string> choices = {};  ///< of a choice
  bool required = false;
};

/// Of a number: least and most, and what it is measured in.
DeclaredKey declared_number(std::string section, std::string key, const Option& option);
DeclaredKey declared_whole(std::string section, std::string key, const Option& option);
DeclaredKey declared_choice(std::string section, std::string key, std::vector<std::string> names);

/// "0.001 min to 1e+05 min", "at least 0"; of an option without a most nothing.
std::string range_text(const Option& option);

// What is expected, in the words of messages; expected_quantity() has those of a number.
inline constexpr const char* expected_vector = "a list of three values";
inline constexpr const char* expected_matrix = "three rows of three values";
inline constexpr const char* expected_truth_value = "true or false";
inline constexpr std::size_t longest_text = 200;  // [bytes]
std::string expected_text();
std::string expected_whole(const Option& option);
std::string expected_choice(const std::vector<std::string>& names);
/// `path`: its dotted key.
std::string expected_section(const std::string& path);
std::string expected_sections(const std::string& path);
/// A whole number without a most: the largest 64-bit number is no double.
inline bool unbounded_whole(const Option& option) {
  return option.max >= 0x1p64;
}

}  // namespace drift::config
