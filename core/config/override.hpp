#pragma once

#include <string>
#include <string_view>

#include "core/config/node.hpp"

namespace drift::config {

/// Replaces or adds one value of the tree, as `--set key=value` asks. `key` is dotted, with quotes
/// around parts that hold dots; an element of a list is addressed by its number from 0 or, for
/// [[filter]] and [[plan.position]], by its `name`, for [[term]] by its `key`:
/// filter.corrected.coupling. Missing tables on the way are created; whether the key means anything
/// is for the strict reader to say. InputError (config), naming `--set key`, if the way leads
/// nowhere or the value is broken.
void apply_override(Node& root, const std::string& key, std::string_view value);

/// The same, but a table is laid over the one that is there: what it does not name stays as it is.
/// A distribution (`{ normal = [...] }`) is one value and takes the place of another one.
void apply_overlay(Node& root, const std::string& key, std::string_view value);

/// The same key with every element of a list by its number: "filter.corrected.coupling" is
/// "filter.0.coupling". As it is from where it leads nowhere, or if it is no dotted key.
std::string numbered(const Node& root, const std::string& key);

/// Adds to the end of a list that the tree has, as `--set key+=value` asks: one value, or each of a
/// list of them. InputError (config) if there is no such list.
void apply_addition(Node& root, const std::string& key, std::string_view value);

}  // namespace drift::config
