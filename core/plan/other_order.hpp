#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/plan/attitude_slips.hpp"

namespace drift {

/// Positions of the plan, from 0, whose attitudes sights show within largest_mismatch: each its
/// own, or the only one that it fits. None if one fits none or several, or two the same. mismatch:
/// of a sight and a position of the plan [rad].
std::optional<std::vector<std::size_t>> shown_positions(
    const std::vector<Sight>& sights, std::size_t positions,
    const std::function<double(const Sight&, std::size_t)>& mismatch);

/// What to do where sights show the attitudes of other positions of the plan, in words: the order
/// for the plan, or the numbers for a recording that left positions out. A question where they show
/// none of these.
/// complete: every position of the recording is among the sights.
std::string other_order_advice(const std::optional<std::vector<std::size_t>>& shown, bool complete);

}  // namespace drift
