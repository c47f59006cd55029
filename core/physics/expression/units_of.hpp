#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/base/units.hpp"
#include "core/physics/expression/tree.hpp"

namespace drift {

/// What a number measures; none: it may measure anything.
using MaybeDimension = std::optional<Dimension>;

/// "angle / time / g", for messages; "a plain number".
std::string dimension_in_words(const Dimension& dimension);

/// What the whole equation measures, worked out from its names. A number in figures may stand for
/// any unit ("t / 3600", "1 + abs(f_z)"), and what it multiplies or is added to is not held to
/// anything; where names alone meet, what is added must measure the same, and functions take plain
/// numbers or angles.
OrMistake<MaybeDimension> dimension_of(const EquationTree& tree,
                                       std::span<const MaybeDimension> inputs,
                                       std::span<const MaybeDimension> parameters);

}  // namespace drift
