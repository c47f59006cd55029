#pragma once

#include <string>
#include <vector>

#include "analysis/diagnosis/findings/remark.hpp"
#include "core/base/linalg.hpp"

namespace drift::diagnosis {

/// Cosines between the projected signatures of the causes in question.
struct CosineMatrix {
  std::vector<std::string> labels;
  MatX cosine;
};

/// Two effects that leave the same trace on this plan (inference::same_trace()).
struct Twins {
  NamedEffect one, other;
};

}  // namespace drift::diagnosis
