#pragma once

#include "analysis/search/search.hpp"

namespace drift::discovery {

/// Each of several simultaneous causes judged by itself: what the held-out prediction of all
/// positions loses (log score) when the model is fitted again without it. In the order of
/// `best.choices`; empty for one cause.
std::vector<double> judge_members(const Examination& nominal, const Test& test, const Refit& best,
                                  const Nulls& nulls);

}  // namespace drift::discovery
