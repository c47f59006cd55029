#pragma once

#include <optional>

#include "analysis/blind/world.hpp"
#include "core/base/rng.hpp"

namespace drift::blind {

/// Terms of the library that a nominal filter leaves out and that act in a definite way, by number;
/// of those that want a temperature which has moved those that have one. Terms that are random
/// alone belong to the noise, not here.
std::vector<std::size_t> hideable_terms(const FilterSpec& nominal, const Timeline& timeline);

/// Terms in the order in which trial `index` of a stratum tries them: each is first for equally
/// many trials.
std::vector<std::size_t> in_turn(std::vector<std::size_t> terms, std::uint64_t seed,
                                 std::size_t index);

/// The amplitudes of a term that a nominal filter leaves out.
std::vector<std::size_t> missing_parameters(const TermInfo& term, const FilterSpec& nominal);

/// One way in which a term may be missing: an axis of it, or one parameter of that axis; the shares
/// of several parameters drawn from their priors, nonlinear ones between the ends of their grids,
/// times not beyond the test. Strength 1 is one prior sigma; more than `most` prior sigmas are
/// implausible. Empty if the term cannot act in this world (frame_closure of a servo).
std::optional<Source> library_source(std::size_t term, const World& world,
                                     const FilterSpec& nominal, double most, Stream& stream);

}  // namespace drift::blind
