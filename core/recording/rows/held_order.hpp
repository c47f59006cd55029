#pragma once

#include <string>
#include <vector>

namespace drift {

/// What to do where positions were held in another order than their numbers ascend, in words: the
/// order in which they were, for the plan, and how to number them in it.
/// position: of every row.
std::string held_order_advice(const std::vector<double>& position);

}  // namespace drift
