#pragma once

#include <vector>

namespace drift::stats {

/// The value in the middle of the sorted ones, of an even number the mean of the two; NaN of none.
double median(std::vector<double> values);

/// Of an even number the upper of the two: a value that occurs, as where steps or lengths are
/// counted.
double upper_median(std::vector<double> values);

}  // namespace drift::stats
