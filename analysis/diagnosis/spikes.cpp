#include "analysis/diagnosis/spikes.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/inference/thresholds.hpp"

namespace drift::diagnosis {
namespace {

using inference::SampleLimits;

constexpr int reach = 2;                          // samples to either side
constexpr double median_of_size = 0.6745 * 1.14;  // a normal against the median of four others

struct Difference {
  int axis, sample;
  double size, spread;  ///< from the median around it; of those around it
};

std::vector<Difference> differences(const Mat3X& residual, const std::vector<Interval>& intervals) {
  const auto n = static_cast<int>(residual.cols());
  std::vector<Difference> all;
  for (int a = 0; a < 3; ++a)
    for (int i = 0; i < n; ++i) {
      // Rows beside one in a turn were read at another rate: what begins a turn is no spike.
      if (!std::isfinite(residual(a, i)) || intervals[static_cast<std::size_t>(i)].turn) continue;
      std::vector<double> around;
      for (int k = std::max(0, i - reach); k <= std::min(n - 1, i + reach); ++k)
        if (k != i && std::isfinite(residual(a, k)) &&
            intervals[k].position == intervals[i].position &&
            intervals[k].slew == intervals[i].slew)
          around.push_back(residual(a, k));
      if (around.size() < 3) continue;
      std::sort(around.begin(), around.end());
      const double median = 0.5 * (around[around.size() / 2] + around[(around.size() - 1) / 2]);
      all.push_back({a, i, std::abs(residual(a, i) - median), around.back() - around.front()});
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
  const double noise = middle->size / median_of_size;
  const double limit = SampleLimits::spike * (noise > SampleLimits::spike_noise ? noise : 1.0);
  std::erase_if(all, [&](const Difference& d) {
    return d.size <= limit + SampleLimits::spike_spread * d.spread;
  });
  return all;
}

}  // namespace

Despiked without_spikes(Measurements measured, const Timeline& timeline, const Readout& readout,
                        const BatchResult& fit) {
  std::size_t removed = 0;
  const auto clean = [&](Mat3X& values, const Mat3X& residual) {
    for (const Difference& d : spikes_of(residual, timeline.intervals)) {
      values(d.axis, d.sample) = std::nan("");
      ++removed;
    }
  };
  if (readout.accelerometers) clean(measured.acc, fit.acc_residual);
  if (readout.gimbals) clean(measured.gimbal, fit.gimbal_residual);
  return {std::move(measured), removed};
}

}  // namespace drift::diagnosis
