#pragma once

#include <vector>

#include "analysis/diagnosis/findings/remark.hpp"
#include "analysis/diagnosis/findings/twins.hpp"
#include "analysis/search/cause.hpp"
#include "analysis/search/search.hpp"

namespace drift::diagnosis {

/// The causes of the credible set and what they can be confused with.
struct CausesFound {
  std::vector<search::Cause> causes;
  CosineMatrix cosines;
  std::vector<Twins> inseparable;
  std::vector<Remark> remarks;
};
CausesFound causes_of(const search::Fitted& nominal, const search::Search& found);

}  // namespace drift::diagnosis
