#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

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

/// Whether another recording begins with interval i, after the first.
inline bool follows_a_recording(const Timeline& timeline, std::size_t i) {
  return i > 0 && timeline.intervals[i].begins;
}

/// Whether the timeline is of more than one recording.
inline bool of_several_recordings(const Timeline& timeline) {
  return std::ranges::count(timeline.intervals, true, &Interval::begins) > 1;
}

/// The number of each interval's recording, from 0.
inline std::vector<std::size_t> recording_of_each(const Timeline& timeline) {
  std::vector<std::size_t> numbers;
  numbers.reserve(timeline.intervals.size());
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i)
    numbers.push_back(i == 0 ? 0 : numbers.back() + (follows_a_recording(timeline, i) ? 1 : 0));
  return numbers;
}

/// From the end of the interval before, or the beginning of its recording, to the end of interval i
/// [s].
inline double time_since_before(const Timeline& timeline, std::size_t i) {
  const Interval& now = timeline.intervals[i];
  const double gap = now.begins ? 0.0 : now.t0 - timeline.intervals[i - 1].t1;
  return now.length() + std::max(0.0, gap);
}

/// Of how many samples the first block of a stretch is, after which an estimator linearises anew;
/// each further one is of twice as many: six blocks or so, however densely a stretch is sampled.
inline std::size_t first_block(std::size_t samples) {
  return std::max<std::size_t>(1, samples / 32);
}

/// Whether a chain ends with interval i.
inline bool ends_chain(const Timeline& timeline, std::size_t i) {
  return i + 1 == timeline.intervals.size() || timeline.intervals[i + 1].cage;
}

}  // namespace drift
