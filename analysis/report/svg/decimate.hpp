#pragma once

#include <span>
#include <vector>

namespace drift::report {

/// Points of a curve that are enough to draw it: at most `most` indices, ascending. Of each stretch
/// the lowest and the highest point stay, and one point that is not finite, so that extremes and
/// gaps are seen. Curves of at most `most` points keep them all.
std::vector<std::size_t> decimated(std::span<const double> y, std::size_t most = 2000);

}  // namespace drift::report
