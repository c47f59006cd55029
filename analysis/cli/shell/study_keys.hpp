#pragma once

#include <string>
#include <vector>

#include "core/config/declared_key.hpp"

namespace drift::cli {

/// One key that a study file may have, as its reader declares it.
struct StudyKey {
  using Kind = config::DeclaredKey::Kind;
  std::string key;   ///< the last part of the path
  std::string path;  ///< "plan.dwell"; of an element of a list "filter[].name"
  Kind kind = Kind::text;
  std::string expected;              ///< in the words of the reader: what may stand there
  config::Option option;             ///< of a number: unit, least and most
  std::vector<std::string> choices;  ///< of a choice
  bool required = false;
  std::vector<StudyKey> keys;  ///< of a section
};

/// Every key of a study file. Nothing is listed by hand: the reader declares each key that it asks
/// for, and reads a tree that has every section it declares.
std::vector<StudyKey> study_keys();

}  // namespace drift::cli
