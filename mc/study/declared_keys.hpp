#pragma once

#include <vector>

#include "core/config/declared_key.hpp"
#include "core/config/node.hpp"

namespace drift::mc {

/// Every key that the reader of study files asks for in such a tree, and what it takes. What is
/// wrong with the tree is nobody's concern here.
std::vector<config::DeclaredKey> declared_keys(const config::Node& root);

}  // namespace drift::mc
