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

/// How far a value [unit of the parameter] is from what the nominal model would believe of it, in
/// sigmas of that; NaN where that is one value.
double prior_sigmas(const FilterSpec& nominal, std::size_t param, double value);

}  // namespace drift::diagnosis
