#include "analysis/inference/scan.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace drift::inference {
namespace {

using Equation = Window::Equation;

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

std::string equation_name(Equation equation, int axis) {
  static constexpr const char* gimbals[] = {"outer", "middle", "inner"};
  switch (equation) {
    case Equation::rate:
      return fmt::format("platform rate {}", "xyz"[axis]);
    case Equation::attitude:
      return fmt::format("attitude offset {}", "xyz"[axis]);
    case Equation::accelerometer:
      return fmt::format("accelerometer {}", "xyz"[axis]);
    case Equation::gimbal:
      break;
  }
  return fmt::format("gimbal {}", gimbals[axis]);
}

VecX window_signature(const LinearProblem& problem, const Timeline& timeline, const Window& w,
                      Eigen::Index first, Eigen::Index count) {
  VecX s = VecX::Zero(count);
  Vec3 turned = Vec3::Zero();  // attitude that the box has made, in the units of psi
  std::size_t done = w.first;  // intervals before this one are in `turned`
  for (Eigen::Index r = 0; r < count; ++r) {
    const RowTag& tag = problem.tags[first + r];
    const std::size_t i = tag.interval;
    const bool inside = i >= w.first && i < w.end;
    switch (w.equation) {
      case Equation::accelerometer:
        if (inside && tag.channel == w.axis) s[r] = 1.0 / problem.acc_sigma;
        break;
      case Equation::gimbal:
        if (inside && tag.channel == 3 + w.axis) s[r] = 1.0 / problem.gimbal_sigma;
        break;
      case Equation::attitude:
        if (inside) {
          const Node& node = timeline.nodes[timeline.intervals[i].middle_node()];
          s[r] = problem.psi.row(first + r).dot((node.R_il * node.R_lr).col(w.axis)) /
                 problem.attitude_sigma;
        }
        break;
      case Equation::rate:
        // per_rate is per gyro drift, which turns the platform the other way.
        for (; done < std::min(i, w.end); ++done)
          turned -= problem.drives[done].per_rate.col(w.axis);
        s[r] = problem.psi.row(first + r).dot(turned);
        if (inside)
          s[r] -= (tag.accelerometer() ? 0.5 : 1.0) *
                  problem.psi.row(first + r).dot(problem.drives[i].per_rate.col(w.axis));
        break;
    }
  }
  return s;
}

std::vector<PositionScan> scan_windows(const LinearProblem& problem, const Timeline& timeline,
                                       const Projector& projector) {
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
      for (const Equation e :
           {Equation::rate, Equation::attitude, Equation::accelerometer, Equation::gimbal})
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
    scan.scan = projector.scan(columns, first);
    scan.T = VecX::Zero(columns.cols());
    for (Eigen::Index k = 0; k < columns.cols(); ++k)
      if (scan.scan.C(k, k) > 1e-6 * scan.scan.raw[k] && scan.scan.C(k, k) > 0.0)
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
    // Unit variance, so that least_information does not take a weak window away.
    const VecX scale = s.C.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const MatX correlation = scale.asDiagonal() * s.C * scale.asDiagonal();
    std::vector<Contrast> contrasts;
    for (Eigen::Index k = 0; k < s.C.cols(); ++k)
      if (s.C(k, k) > 1e-6 * s.raw[k] && s.C(k, k) > 0.0)
        contrasts.push_back(
            make_contrast(correlation, VecX::Ones(s.C.cols()), {static_cast<int>(k)}));
    families.emplace_back(correlation, contrasts, draws, 1000 + p);
  }
  return MaxNull::joined(families);
}

}  // namespace drift::inference
