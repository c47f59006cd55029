#pragma once

#include <vector>

#include "analysis/diagnosis/remark.hpp"
#include "analysis/search/cause.hpp"
#include "analysis/search/search.hpp"
#include "core/base/linalg.hpp"

namespace drift::diagnosis {

/// Cosines between the projected signatures of the causes in question.
struct CosineMatrix {
  std::vector<std::string> labels;
  MatX cosine;
};

/// Two effects that are one direction on this plan, whatever the data.
struct Twins {
  NamedEffect one, other;
};

/// The causes of the credible set and what they can be confused with.
struct CausesFound {
  std::vector<search::Cause> causes;
  CosineMatrix cosines;
  std::vector<Twins> inseparable;
  std::vector<Remark> remarks;
};
CausesFound causes_of(const search::Fitted& nominal, const search::Search& found);

}  // namespace drift::diagnosis
