#include "analysis/identification/spikes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "analysis/inference/thresholds.hpp"
#include "core/plan/stretches_and_chains.hpp"
#include "core/stats/among_neighbours.hpp"

namespace drift::identification {
namespace {

using inference::SampleLimits;

constexpr int reach = 2;  // samples to either side

struct Difference {
  int axis, sample;
  double size, spread;  ///< from the median around it; of those around it
  bool first;           ///< of its dwell or slew
};

/// The rows about one of a slew, two to either side, of whatever comes before and after it as long
/// as the platform is not caged: it moves fast, and goes on from there. None at the ends of a
/// chain, and of a slew of so few rows that one is a motion by itself.
std::optional<std::pair<int, int>> rows_about_in_slew(int i,
                                                      const std::vector<Interval>& intervals) {
  const auto at = [&](int k) -> const Interval& { return intervals[static_cast<std::size_t>(k)]; };
  const int first = i - reach, last = i + reach;
  if (first < 0 || last >= static_cast<int>(intervals.size()) || at(first).chain != at(last).chain)
    return std::nullopt;
  int slewing = 0;
  for (int k = first; k <= last; ++k)
    slewing += at(k).slew && at(k).position == at(i).position ? 1 : 0;
  if (slewing <= reach) return std::nullopt;
  return std::pair{first, last};
}

/// The rows about one of a dwell, two to either side; at its ends as many, from the one side that
/// there is.
std::pair<int, int> rows_about_in_dwell(int i, const std::vector<Interval>& intervals) {
  const auto same = [&](int k) {
    return k >= 0 && k < static_cast<int>(intervals.size()) &&
           intervals[static_cast<std::size_t>(k)].position ==
               intervals[static_cast<std::size_t>(i)].position &&
           !intervals[static_cast<std::size_t>(k)].slew;
  };
  int first = i, last = i;
  while (first > i - reach && same(first - 1)) --first;
  while (last < i + reach && same(last + 1)) ++last;
  while (last - first < 2 * reach && same(last + 1)) ++last;
  while (last - first < 2 * reach && same(first - 1)) --first;
  return {first, last};
}

std::vector<Difference> differences(const Mat3X& residual, const std::vector<Interval>& intervals) {
  const auto n = static_cast<int>(residual.cols());
  std::vector<Difference> all;
  for (int a = 0; a < 3; ++a)
    for (int i = 0; i < n; ++i) {
      // Rows beside one in a turn were read at another rate: what begins a turn is no spike.
      if (!std::isfinite(residual(a, i)) || intervals[static_cast<std::size_t>(i)].turn) continue;
      std::vector<double> around;
      const bool slew = intervals[static_cast<std::size_t>(i)].slew;
      const auto about = slew ? rows_about_in_slew(i, intervals)
                              : std::optional(rows_about_in_dwell(i, intervals));
      if (!about) continue;
      const auto [first, last] = *about;
      for (int k = first; k <= last; ++k)
        if (k != i && std::isfinite(residual(a, k))) around.push_back(residual(a, k));
      if (around.size() < 3) continue;
      // A curve of one bend takes the middle one of five two ranges of three away at most, where it
      // bends at its end any number.
      const bool amid = !slew && i - first == reach && last - i == reach &&
                        around.size() == static_cast<std::size_t>(2 * reach);
      const auto among = stats::among_neighbours(residual(a, i), around, amid);
      all.push_back({a, i, among.size, among.spread, first == i});
    }
  return all;
}

/// The samples of one channel triad that are spikes.
std::vector<Difference> spikes_of(const Mat3X& residual, const std::vector<Interval>& intervals) {
  std::vector<Difference> all = differences(residual, intervals);
  if (all.empty()) return {};
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end(),
                   [](const Difference& x, const Difference& y) { return x.size < y.size; });
  const double noise = middle->size / stats::usual_size_among_four;
  const double limit = SampleLimits::spike * std::max(noise, 1.0);
  std::erase_if(all, [&](const Difference& d) {
    return d.size <= limit + SampleLimits::spike_spread * d.spread;
  });
  // What begins several dwells decays, and is no sample that went astray.
  std::set<int> begins;
  for (const Difference& d : all)
    if (d.first) begins.insert(d.sample);  // of several channels at once: one beginning
  if (begins.size() > 1) std::erase_if(all, [](const Difference& d) { return d.first; });
  return all;
}

}  // namespace

Despiked without_spikes(Measurements measured, const Timeline& timeline, const Readout& readout,
                        const BatchResult& fit) {
  std::vector<Spike> spikes;
  const std::vector<std::size_t> recording = recording_of_each(timeline);
  const auto offset = [&](std::size_t number) {
    return number < timeline.recordings.size() ? timeline.recordings[number].offset : 0.0;
  };
  const auto clean = [&](Mat3X& values, const Mat3X& residual, int first_channel) {
    for (const Difference& d : spikes_of(residual, timeline.intervals)) {
      values(d.axis, d.sample) = std::nan("");
      const auto at = static_cast<std::size_t>(d.sample);
      const Interval& i = timeline.intervals[at];
      const bool ends = at + 1 < timeline.intervals.size() && recording[at + 1] == recording[at] &&
                        timeline.intervals[at + 1].position != i.position;
      spikes.push_back({first_channel + d.axis, i.t1 - offset(recording[at]), i.position + 1, ends,
                        recording[at] + 1});
    }
  };
  if (readout.accelerometers) clean(measured.acc, fit.acc_residual, 0);
  if (readout.gimbals) clean(measured.gimbal, fit.gimbal_residual, 3);
  return {std::move(measured), std::move(spikes)};
}

std::size_t late_labels(const std::vector<Spike>& spikes) {
  std::set<std::pair<std::size_t, int>> positions;
  for (const Spike& s : spikes) {
    if (!s.ends_position) return 0;
    positions.emplace(s.recording, s.position);
  }
  return positions.size() < SampleLimits::late_positions ? 0 : positions.size();
}

}  // namespace drift::identification
