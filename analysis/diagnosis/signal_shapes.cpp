#include "analysis/diagnosis/signal_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/plan/stretches_and_chains.hpp"

namespace drift::diagnosis {
namespace {

using Kind = Shape::Kind;

/// Times of the middles of the bins: through all recordings, since their recording began, and
/// since their position did [s].
struct BinTimes {
  VecX t, in_recording, in_position;
  double longest = 0.0;              ///< of the longest recording [s]
  Eigen::Index bins_of_longest = 0;  ///< in that
};

BinTimes times_of(const InputEstimate& input, const Timeline& timeline) {
  const auto n = static_cast<Eigen::Index>(input.bins.size());
  BinTimes times{VecX(n), VecX(n), VecX(n)};
  Eigen::Index first_bin = 0;  // of its recording
  for (Eigen::Index k = 0; k < n; ++k) {
    times.t[k] = middle_time(timeline, input.bins[k]);
    std::size_t start = input.bins[k].first;
    const Interval& now = timeline.intervals[start];
    while (start > 0 && !follows_a_recording(timeline, start) &&
           timeline.intervals[start - 1].position == now.position)
      --start;
    times.in_recording[k] = times.t[k] - now.t_begin;
    times.in_position[k] = times.t[k] - timeline.intervals[start].t0;
    if (follows_a_recording(timeline, input.bins[k].first)) first_bin = k;
    const double until_now = timeline.intervals[input.bins[k].second - 1].t1 - now.t_begin;
    if (until_now <= times.longest) continue;
    times.longest = until_now;
    times.bins_of_longest = k + 1 - first_bin;
  }
  return times;
}

/// Clocks begin anew with each recording, and so do the shapes that go by them; a swing is no
/// longer than twice in the longest of them.
std::vector<ShapeColumns> shapes_of_time(const InputEstimate& input, const Timeline& timeline) {
  std::vector<ShapeColumns> all;
  const auto n = static_cast<Eigen::Index>(input.bins.size());
  const BinTimes times = times_of(input, timeline);
  const VecX& since = times.in_recording;
  all.push_back({{Kind::ramp}, since / times.longest});
  for (const double tau : {600.0, 1800.0, 3600.0, 7200.0, 14400.0}) {  // [s]
    if (tau < times.longest)
      all.push_back({{Kind::decay_from_start, tau}, (-since.array() / tau).exp()});
    if (tau < 3600.0)
      all.push_back({{Kind::decay_in_position, tau}, (-times.in_position.array() / tau).exp()});
  }
  for (Eigen::Index k = 1; k < n; ++k)
    all.push_back({{Kind::onset, timeline.intervals[input.bins[k].first].t0},
                   (times.t.array() >= times.t[k]).cast<double>().matrix()});
  for (int halves = 4; halves <= times.bins_of_longest / 4 + 1; ++halves) {
    const double period = 2.0 * times.longest / static_cast<double>(halves);
    MatX two(n, 2);
    two.col(0) = (since.array() * (2.0 * std::numbers::pi / period)).cos();
    two.col(1) = (since.array() * (2.0 * std::numbers::pi / period)).sin();
    all.push_back({{Kind::period, period}, two});
  }
  return all;
}

/// What the platform feels: specific force along its axes, and products.
std::vector<ShapeColumns> shapes_of_force(const InputEstimate& input, const Timeline& timeline) {
  std::vector<ShapeColumns> all;
  const auto n = static_cast<Eigen::Index>(input.bins.size());
  MatX a(n, 3);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto middle =
        timeline.intervals[(input.bins[k].first + input.bins[k].second - 1) / 2].middle_node();
    a.row(k) = timeline.nodes[middle].R_lr.row(2);
  }
  for (int i = 0; i < 3; ++i) {
    all.push_back({{Kind::specific_force, 0.0, i}, a.col(i)});
    for (int j = 0; j <= i; ++j)
      all.push_back({{Kind::specific_force_square, 0.0, j, i}, a.col(i).cwiseProduct(a.col(j))});
  }
  return all;
}

std::vector<ShapeColumns> shapes_of_position(const InputEstimate& input, const Timeline& timeline) {
  std::vector<ShapeColumns> all;
  const auto n = static_cast<Eigen::Index>(input.bins.size());
  std::vector<int> seen;
  for (const auto& bin : input.bins) {
    const int position = timeline.intervals[bin.first].position;
    if (std::find(seen.begin(), seen.end(), position) != seen.end()) continue;
    seen.push_back(position);
    VecX v(n);
    for (Eigen::Index k = 0; k < n; ++k)
      v[k] = timeline.intervals[input.bins[k].first].position == position;
    all.push_back({{Kind::one_position, 0.0, 0, 0, position + 1}, v});
  }
  return all;
}

/// Of several recordings each but the last, which an onset at its beginning is the same as.
std::vector<ShapeColumns> shapes_of_recording(const InputEstimate& input,
                                              const Timeline& timeline) {
  std::vector<ShapeColumns> all;
  const auto n = static_cast<Eigen::Index>(input.bins.size());
  const std::vector<std::size_t> recording = recording_of_each(timeline);
  for (std::size_t r = 0; r < recording.back(); ++r) {
    VecX v(n);
    for (Eigen::Index k = 0; k < n; ++k) v[k] = recording[input.bins[k].first] == r;
    Shape shape{Kind::one_recording};
    shape.recording = static_cast<int>(r) + 1;
    all.push_back({shape, v});
  }
  return all;
}

std::vector<ShapeColumns> shapes_of_covariates(
    const InputEstimate& input, const std::vector<preparation::Covariate>& covariates) {
  std::vector<ShapeColumns> all;
  const auto n = static_cast<Eigen::Index>(input.bins.size());
  for (const preparation::Covariate& c : covariates) {
    VecX v(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      double sum = 0.0, count = 0.0;
      for (std::size_t i = input.bins[k].first; i < input.bins[k].second; ++i)
        if (std::isfinite(c.value[i])) {
          sum += c.value[i];
          count += 1.0;
        }
      v[k] = count > 0.0 ? sum / count : 0.0;
    }
    const double mean = v.mean();
    v.array() -= mean;
    if (v.norm() > 0.0) all.push_back({{Kind::covariate, 0.0, 0, 0, 0, c.name}, v});
  }
  return all;
}

}  // namespace

std::vector<ShapeColumns> signal_shapes(const InputEstimate& input, const Timeline& timeline,
                                        const std::vector<preparation::Covariate>& covariates) {
  std::vector<ShapeColumns> all = shapes_of_time(input, timeline);
  for (auto more : {shapes_of_force(input, timeline), shapes_of_position(input, timeline),
                    shapes_of_recording(input, timeline), shapes_of_covariates(input, covariates)})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace drift::diagnosis
