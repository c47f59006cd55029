#include "analysis/inference/scan.hpp"

#include <algorithm>

#include "analysis/inference/thresholds.hpp"

namespace drift::inference {
namespace {

/// Windows over intervals [first, end): the whole, halves and quarters with half overlap.
std::vector<std::pair<std::size_t, std::size_t>> spans(std::size_t first, std::size_t end) {
  std::vector<std::pair<std::size_t, std::size_t>> all{{first, end}};
  const std::size_t n = end - first;
  for (const std::size_t parts : {2u, 4u}) {
    if (n < 2 * parts) break;
    for (std::size_t k = 0; k + 2 <= 2 * parts; ++k)  // starts at every half part
      all.emplace_back(first + k * n / (2 * parts), first + (k + 2) * n / (2 * parts));
  }
  return all;
}

}  // namespace

VecX window_signature(const MeasuredRows& rows, const Timeline& timeline, const Window& w,
                      Eigen::Index first, Eigen::Index count) {
  VecX s = VecX::Zero(count);
  Vec3 turned = Vec3::Zero();  // attitude that the box has made, in the units of psi
  std::size_t done = w.first;  // intervals before this one are in `turned`
  for (Eigen::Index r = 0; r < count; ++r) {
    const RowTag& tag = rows.tags[first + r];
    const std::size_t i = tag.interval;
    const bool inside = i >= w.first && i < w.end;
    switch (w.equation) {
      case Equation::accelerometer:
        if (inside && tag.channel == w.axis) s[r] = 1.0 / rows.acc_sigma_of(tag);
        break;
      case Equation::gimbal:
        if (inside && tag.channel == 3 + w.axis) s[r] = 1.0 / rows.gimbal_sigma_of(tag);
        break;
      case Equation::attitude:
        if (inside) {
          const Node& node = timeline.nodes[timeline.intervals[i].middle_node()];
          s[r] = rows.psi.row(first + r).dot((node.R_il * node.R_lr).col(w.axis)) /
                 rows.attitude_sigma;
        }
        break;
      case Equation::rate:
        // per_rate is per gyro drift, which turns the platform the other way.
        for (; done < std::min(i, w.end); ++done) turned -= rows.drives[done].per_rate.col(w.axis);
        s[r] = rows.psi.row(first + r).dot(turned);
        if (inside)
          s[r] -= (tag.accelerometer() ? 0.5 : 1.0) *
                      rows.psi.row(first + r).dot(rows.drives[i].per_rate.col(w.axis)) +
                  rows.per_drift(tag, w.axis);
        break;
    }
  }
  return s;
}

std::vector<PositionScan> scan_windows(const LinearProblem& problem, const Timeline& timeline,
                                       const Projector& projector, Cross cross) {
  std::vector<PositionScan> all;
  for (Eigen::Index first = 0; first < problem.rows();) {
    // A run of rows of one position within one chain.
    const auto chain = [&](Eigen::Index k) {
      return timeline.intervals[problem.tags[k].interval].chain;
    };
    const int position = problem.tags[first].position;
    Eigen::Index end = first;
    while (end < problem.rows() && problem.tags[end].position == position &&
           chain(end) == chain(first))
      ++end;
    PositionScan scan;
    for (const auto& [a, b] :
         spans(problem.tags[first].interval, problem.tags[end - 1].interval + 1))
      for (const Equation e : equations_of(timeline))
        for (int axis = 0; axis < 3; ++axis)
          scan.windows.push_back({e, axis, position, a, b, timeline.intervals[a].t0,
                                  timeline.intervals[b - 1].t1, 1.0});
    MatX columns(end - first, scan.windows.size());
    for (std::size_t k = 0; k < scan.windows.size(); ++k) {
      columns.col(k) = window_signature(problem, timeline, scan.windows[k], first, end - first);
      const double norm = columns.col(k).norm();
      if (norm <= 0.0) continue;
      columns.col(k) /= norm;
      scan.windows[k].unit = 1.0 / norm;
    }
    scan.scan = cross == Cross::known ? projector.scan(columns, first)
                                      : projector.scan_alone(columns, first);
    scan.T = VecX::Zero(columns.cols());
    for (Eigen::Index k = 0; k < columns.cols(); ++k)
      if (scan.scan.C(k, k) > VisibleLimits::left * scan.scan.raw[k] && scan.scan.C(k, k) > 0.0)
        scan.T[k] = scan.scan.g[k] * scan.scan.g[k] / scan.scan.C(k, k);
    all.push_back(std::move(scan));
    first = end;
  }
  return all;
}

MaxNull scan_null(const std::vector<PositionScan>& scans, int draws) {
  std::vector<MaxNull> families;
  for (std::size_t p = 0; p < scans.size(); ++p) {
    const auto& s = scans[p].scan;
    // Unit variance, so that VisibleLimits::information does not take a weak window away.
    const VecX scale = s.C.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const MatX correlation = scale.asDiagonal() * s.C * scale.asDiagonal();
    std::vector<Contrast> contrasts;
    for (Eigen::Index k = 0; k < s.C.cols(); ++k)
      if (s.C(k, k) > VisibleLimits::left * s.raw[k] && s.C(k, k) > 0.0)
        contrasts.push_back(
            make_contrast(correlation, VecX::Ones(s.C.cols()), {static_cast<int>(k)}));
    families.emplace_back(correlation, contrasts, draws, 1000 + p);
  }
  return MaxNull::joined(families);
}

}  // namespace drift::inference
