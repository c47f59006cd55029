#pragma once

#include "core/plan/timeline.hpp"

namespace drift {

/// Whether something else begins with interval i: a chain, a position, a slew, a rest; true at the
/// end of the timeline.
inline bool begins_anew(const Timeline& timeline, std::size_t i) {
  if (i == 0 || i == timeline.intervals.size()) return true;
  const Interval &before = timeline.intervals[i - 1], &now = timeline.intervals[i];
  return now.cage || now.position != before.position || now.slew != before.slew ||
         now.rest != before.rest;
}

/// Whether a chain ends with interval i.
inline bool ends_chain(const Timeline& timeline, std::size_t i) {
  return i + 1 == timeline.intervals.size() || timeline.intervals[i + 1].cage;
}

}  // namespace drift
