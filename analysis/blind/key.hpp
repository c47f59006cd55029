#pragma once

#include <string>
#include <vector>

#include "analysis/blind/trial.hpp"

namespace drift::blind {

/// What was hidden in every trial, with a salt that keeps its hash from being guessed.
struct Key {
  std::string salt;
  std::vector<KeyEntry> entries;  ///< in the order of the trials
};

/// 64 hexadecimal digits that depend on the seed and say nothing.
std::string salt_of(std::uint64_t seed);

std::string to_json(const Key& key);
/// InputError (self_check) if the text is no key.
Key read_key(const std::string& json);

}  // namespace drift::blind
