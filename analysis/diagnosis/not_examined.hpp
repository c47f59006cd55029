#pragma once

#include "analysis/diagnosis/findings/not_examined.hpp"
#include "analysis/search/cause.hpp"
#include "analysis/search/fitted.hpp"

namespace drift::diagnosis {

/// The terms that were left out of the comparison, and why; those that the nominal model holds and
/// those that act through random numbers alone are not among them.
std::vector<NotExamined> not_examined(const search::Fitted& nominal,
                                      const std::vector<search::Cause>& causes);

}  // namespace drift::diagnosis
