#pragma once

#include "core/recording/recording.hpp"

namespace drift {

/// The slews of a platform's recording that has numbers of positions and commands, but no `phase`:
/// rows in which commands turn the platform, and rows beside them in which the case is turned, are
/// the way to the next position where the number of the position changes in them or by fewer than
/// CountLimits::fewest_rows rows beside them. They get its number, whichever they have, and rows
/// between them and the change that of their own side. A remark says how many.
///
/// A platform that is commanded within a position is left alone, and so is one that is elsewhere
/// before or behind such rows, by more than a row of its commands turns it (it was caged anew), and
/// one that does not stand for CountLimits::fewest_rows rows in both positions.
void take_commanded_slews(Recording& recording);

}  // namespace drift
