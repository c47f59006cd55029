#pragma once

#include "core/stats/allan.hpp"

namespace drift::stats {

/// A stretch without its polynomial of this degree (least squares); shorter ones become zero.
Stretch without_trend(const Stretch& stretch, int degree);

}  // namespace drift::stats
