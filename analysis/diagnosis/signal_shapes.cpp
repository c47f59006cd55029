#include "analysis/diagnosis/signal_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace drift::diagnosis {
namespace {

using Kind = Shape::Kind;

/// Times of the middles of the bins, and those times since their position began [s].
struct BinTimes {
  VecX t, in_position;
};

BinTimes times_of(const InputEstimate& input, const Timeline& timeline) {
  const auto n = static_cast<Eigen::Index>(input.bins.size());
  BinTimes times{VecX(n), VecX(n)};
  for (Eigen::Index k = 0; k < n; ++k) {
    times.t[k] = middle_time(timeline, input.bins[k]);
    std::size_t start = input.bins[k].first;
    const int position = timeline.intervals[start].position;
    while (start > 0 && timeline.intervals[start - 1].position == position) --start;
    times.in_position[k] = times.t[k] - timeline.intervals[start].t0;
  }
  return times;
}

std::vector<ShapeColumns> shapes_of_time(const InputEstimate& input, const Timeline& timeline) {
  std::vector<ShapeColumns> all;
  const auto n = static_cast<Eigen::Index>(input.bins.size());
  const auto [t, in_position] = times_of(input, timeline);
  const double t0 = timeline.intervals.front().t0, length = timeline.intervals.back().t1 - t0;
  all.push_back({{Kind::ramp}, (t.array() - t0) / length});
  for (const double tau : {600.0, 1800.0, 3600.0, 7200.0, 14400.0}) {  // [s]
    if (tau < length)
      all.push_back({{Kind::decay_from_start, tau}, (-(t.array() - t0) / tau).exp()});
    if (tau < 3600.0)
      all.push_back({{Kind::decay_in_position, tau}, (-in_position.array() / tau).exp()});
  }
  for (Eigen::Index k = 1; k < n; ++k)
    all.push_back({{Kind::onset, timeline.intervals[input.bins[k].first].t0},
                   (t.array() >= t[k]).cast<double>().matrix()});
  for (int cycles = 1; cycles <= n / 4; ++cycles) {
    const double period = 2.0 * length / static_cast<double>(cycles + 1);
    MatX two(n, 2);
    two.col(0) = (t.array() * (2.0 * std::numbers::pi / period)).cos();
    two.col(1) = (t.array() * (2.0 * std::numbers::pi / period)).sin();
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
                    shapes_of_covariates(input, covariates)})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace drift::diagnosis
