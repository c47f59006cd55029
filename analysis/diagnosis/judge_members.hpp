#pragma once

#include "analysis/search/search.hpp"

namespace drift::diagnosis {

/// Each of several simultaneous causes judged by itself: what the held-out prediction of all
/// positions loses (log score) when the model is fitted again without it. In the order of
/// `best.choices`; empty for one cause.
std::vector<double> judge_members(const search::Examination& nominal, const inference::Test& test,
                                  const search::Refit& best, const search::Nulls& nulls);

}  // namespace drift::diagnosis
