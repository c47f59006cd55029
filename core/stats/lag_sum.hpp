#pragma once

#include <span>
#include <vector>

namespace drift::stats {

/// A place and how much its value counts in a sum.
struct LagNode {
  double lag = 0.0, weight = 1.0;
};

/// Nodes that stand for the sum over all whole numbers from the first to the last of `bends`
/// (ascending whole numbers) of a function that is smooth between them: every number close to a
/// bend, and farther away three nodes of Gauss and Legendre for stretches that grow with the
/// distance. A sum over h is the integral over h -1/2 .. +1/2 there, up to f'/24 at the ends.
std::vector<LagNode> lag_nodes(std::span<const double> bends);

}  // namespace drift::stats
