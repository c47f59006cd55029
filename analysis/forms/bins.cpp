#include "analysis/forms/bins.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/inference/scan.hpp"
#include "core/base/decompose.hpp"

namespace drift::forms {
namespace {

/// Stretches of intervals of one position and chain.
std::vector<std::pair<std::size_t, std::size_t>> stretches(const std::vector<Interval>& all) {
  std::vector<std::pair<std::size_t, std::size_t>> out;
  for (std::size_t first = 0; first < all.size();) {
    std::size_t end = first;
    while (end < all.size() && all[end].position == all[first].position &&
           all[end].chain == all[first].chain)
      ++end;
    out.emplace_back(first, end);
    first = end;
  }
  return out;
}

inference::Equation equation_of(OwnSlot slot) {
  switch (slot) {
    case OwnSlot::accelerometer:
      return inference::Equation::accelerometer;
    case OwnSlot::gimbal:
      return inference::Equation::gimbal;
    case OwnSlot::rate:
    case OwnSlot::drift:
      break;
  }
  return inference::Equation::rate;
}

}  // namespace

MatX signatures_of(const OwnTarget& place, const Bins& bins, const inference::MeasuredRows& rows,
                   const Timeline& timeline) {
  const auto& intervals = timeline.intervals;
  MatX columns = MatX::Zero(rows.rows(), bins.size());
  Eigen::Index first = 0;
  for (Eigen::Index k = 0; k < bins.size(); ++k) {
    const auto [begin, end] = bins.intervals[k];
    while (first < rows.rows() && rows.tags[first].interval < begin) ++first;
    // An input to the platform's rate is felt until the next caging.
    Eigen::Index last = first;
    while (last < rows.rows() &&
           intervals[rows.tags[last].interval].chain == intervals[begin].chain)
      ++last;
    const inference::Window box{equation_of(place.slot), place.axis, bins.position[k], begin, end};
    columns.col(k).segment(first, last - first) =
        inference::window_signature(rows, timeline, box, first, last - first);
  }
  return place.slot == OwnSlot::drift ? MatX(-columns) : columns;  // which the platform follows
}

MatX Bins::mean(const MatX& of_intervals) const {
  MatX out(size(), of_intervals.cols());
  for (Eigen::Index k = 0; k < size(); ++k)
    out.row(k) =
        of_intervals
            .middleRows(static_cast<Eigen::Index>(intervals[k].first),
                        static_cast<Eigen::Index>(intervals[k].second - intervals[k].first))
            .colwise()
            .mean();
  return out;
}

Bins bins_of(const Timeline& timeline, std::size_t most) {
  Bins out;
  const auto parts = stretches(timeline.intervals);
  const std::size_t each = std::max<std::size_t>(4, most / std::max<std::size_t>(1, parts.size()));
  std::vector<double> lengths;
  for (const auto& [first, end] : parts) {
    const std::size_t n = std::min(each, end - first);
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t a = first + k * (end - first) / n, b = first + (k + 1) * (end - first) / n;
      const Interval& at = timeline.intervals[a];
      out.intervals.emplace_back(a, b);
      out.position.push_back(at.position);
      out.start.push_back(at.t0 - at.t_begin);
      lengths.push_back(timeline.intervals[b - 1].t1 - at.t0);
    }
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  out.length = *middle;
  return out;
}

bool PlaceInformation::seen(double C, double most_raw) {
  return C > inference::VisibleLimits::left * most_raw && C > 0.0;
}

PlaceInformation::Score PlaceInformation::score(const MatX& columns) const {
  Score out;
  const MatX info = columns.transpose() * C * columns;
  const VecX gradient = columns.transpose() * g;
  const VecX most_raw = (columns.cwiseAbs().transpose() * raw.cwiseSqrt()).cwiseAbs2();
  out.amplitude = VecX::Zero(columns.cols());
  const Eigensystem eigen = eigensystem(info);
  for (Eigen::Index k = 0; k < eigen.values.size(); ++k) {
    if (!seen(eigen.values[k], most_raw.maxCoeff())) continue;
    const VecX direction = eigen.vectors.col(k);
    const double y = direction.dot(gradient);
    out.T += y * y / eigen.values[k];
    out.amplitude += direction * (y / eigen.values[k] * unit);
    ++out.dof;
  }
  return out;
}

PlaceInformation information_on(const OwnTarget& place, const Bins& bins,
                                const inference::MeasuredRows& rows, const Timeline& timeline,
                                const inference::Projector& projector) {
  MatX columns = signatures_of(place, bins, rows, timeline);
  const double norm =
      std::max(columns.norm() / std::sqrt(static_cast<double>(bins.size())), 1e-300);
  columns /= norm;
  inference::Projector::Scan scan = projector.scan(columns, 0);
  return {std::move(scan.C), std::move(scan.g), std::move(scan.raw), 1.0 / norm};
}

}  // namespace drift::forms
