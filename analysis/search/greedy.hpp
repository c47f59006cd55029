#pragma once

#include "analysis/search/remainder.hpp"

namespace drift::search {

/// Further causes one by one, the strongest conditional score each time, until nothing is
/// significant or `most` are in; then those that are not needed are taken out again. Empty if it
/// never gets quiet.
std::vector<Choice> greedy(const Field& field, const std::vector<Score>& scores,
                           double library_threshold, double scan_threshold, std::size_t most);

}  // namespace drift::search
