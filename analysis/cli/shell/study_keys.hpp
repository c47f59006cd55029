#pragma once

#include <string>
#include <vector>

namespace drift::cli {

/// One key that a study file may have, as the strict reader of study files tells of it.
struct StudyKey {
  enum class Kind {
    section,   ///< keys that are listed in turn
    sections,  ///< a list of sections, [[...]]
    table,     ///< keys of the user's own, or parameters
    list,
    choice,
    truth_value,
    whole,     ///< a whole number
    number,    ///< without unit
    quantity,  ///< a number with a unit
    vector,    ///< three values
    matrix,    ///< three rows of three values
    text
  };
  std::string key;   ///< the last part of the path
  std::string path;  ///< "plan.dwell"; of an element of a list "filter[].name"
  Kind kind = Kind::text;
  std::string expected;  ///< in the words of the reader: what may stand there
  std::string range;     ///< of a number or quantity: "0.001 min to 1e+05 min"; or empty
  std::string unit;      ///< of a quantity
  std::vector<std::string> choices;  ///< of a choice
  bool required = false;
  std::vector<StudyKey> keys;  ///< of a section
};

/// Every key of a study file. Nothing is listed by hand: studies with a key that nobody knows, or
/// with a date where no key takes one, are given to the reader, whose messages name the keys that
/// are known and what each expects.
std::vector<StudyKey> study_keys();

}  // namespace drift::cli
