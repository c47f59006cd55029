#include "core/sim/memory_over_gaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/plan/stretches_and_chains.hpp"

namespace drift {
namespace {

/// The part that is left (MemoryOverGap) of a term's state where that is smallest; 1 where the
/// attitude of the gap does not matter. p: parameters of the term.
template <class T>
double part_left(double length, const Vec3& before, const Vec3& after, const double* p) {
  // A memory is of order 1 where its term acts: less has a hundredth of the information.
  constexpr double little = 0.1;
  // A term starts with what has settled in the attitude it is in, or with nothing.
  std::array<double, T::memory> late, settled;
  T::start(PathStep{0.0, before, before}, p, late.data());
  T::start(PathStep{0.0, after, after}, p, settled.data());
  std::array<double, T::memory> early = late;
  T::advance(PathStep{length, after, after}, p, early.data());
  double left = 1.0;
  for (std::size_t k = 0; k < late.size(); ++k)
    if (const double whole = std::abs(settled[k] - late[k]); whole > little)
      left = std::min(left, std::abs(settled[k] - early[k]) / whole);
  return left;
}

}  // namespace

std::vector<MemoryOverGap> memory_over_gaps(const Timeline& timeline, const DriftModel& model,
                                            const Theta& theta) {
  std::vector<MemoryOverGap> all;
  if (timeline.of_case) return all;  // its turns are recorded, and no part of the timeline
  const std::vector<std::size_t> recording = recording_of_each(timeline);
  TermLibrary::for_each_memory(model.terms, [&]<class T>(const TermInfo& term) {
    for (std::size_t n = 1; n < timeline.intervals.size(); ++n) {
      const Interval &last = timeline.intervals[n - 1], &first = timeline.intervals[n];
      const double length = first.t0 - last.t1;
      if (!first.cage || first.begins || length <= 0.0) continue;
      const double left =
          part_left<T>(length, timeline.nodes[last.last_node()].R_lr.row(2),
                       timeline.nodes[first.first_node].R_lr.row(2), theta.data() + term.first);
      if (left < 1.0)
        all.push_back({term.key, last.position, first.position, length, left, recording[n] + 1});
    }
  });
  return all;
}

}  // namespace drift
