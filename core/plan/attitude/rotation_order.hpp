#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/plan/attitude_slips.hpp"

namespace drift {

/// The one other order of rotations about three axes, of which the gimbal angles would show the
/// attitude of the plan at all these sights, in words, and how to convert them: the program's are
/// Rx(outer) Ry(middle) Rz(inner). A column stays with its axis, or its place in the order. Empty
/// where no order does, or several do, or fewer than three sights tell.
std::optional<std::string> rotation_order_behind(const std::vector<Sight>& sights);

}  // namespace drift
