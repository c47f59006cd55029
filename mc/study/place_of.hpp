#pragma once

#include <string>

#include "mc/study/study.hpp"

namespace drift::mc {

/// Where a key of a study was given, for messages: "dir/lab.toml:12" (" and --set" where that added
/// to the list), "--set truth.terms", or the file alone where the value is that of default.
std::string place_of(const Study& study, const std::string& key);

}  // namespace drift::mc
