#pragma once

#include "core/config/node.hpp"
#include "mc/study/study.hpp"

namespace drift::mc {

/// InputError (config), with the line of each, if an axis of [sweep] has several values none of
/// which changes what the runs depend on (run_inputs()) at any value of the others: its points
/// would be one, told as several. `root`: the tree that the study was read from.
///
/// An axis some of whose values do is none, nor is one beside which a point cannot be read. Of a
/// sweep of many points those are looked at that some thousand readings reach.
void refuse_idle_axes(const config::Node& root, const Study& study);

}  // namespace drift::mc
