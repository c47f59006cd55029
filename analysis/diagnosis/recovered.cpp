#include "analysis/diagnosis/recovered.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/diagnosis/signal_shapes.hpp"
#include "analysis/inference/thresholds.hpp"
#include "core/base/decompose.hpp"

namespace drift::diagnosis {
namespace {

using Equation = inference::Equation;

/// Bins of equal length within every position (its slew included).
std::vector<std::pair<std::size_t, std::size_t>> make_bins(const Timeline& timeline,
                                                           int per_position) {
  std::vector<std::pair<std::size_t, std::size_t>> bins;
  const auto& all = timeline.intervals;
  for (std::size_t first = 0; first < all.size();) {
    std::size_t end = first;
    while (end < all.size() && all[end].position == all[first].position &&
           all[end].chain == all[first].chain)
      ++end;
    const std::size_t parts = std::min<std::size_t>(per_position, end - first);
    for (std::size_t k = 0; k < parts; ++k)
      bins.emplace_back(first + k * (end - first) / parts, first + (k + 1) * (end - first) / parts);
    first = end;
  }
  return bins;
}

/// Chooses size and time constant of the prior by likelihood and smooths.
void smooth(InputEstimate& input, const Timeline& timeline) {
  const auto n = static_cast<Eigen::Index>(input.bins.size());
  VecX t(n);
  for (Eigen::Index k = 0; k < n; ++k) t[k] = middle_time(timeline, input.bins[k]);
  const double length = timeline.intervals.back().t1 - timeline.intervals.front().t0;
  const double information = std::max(input.C.diagonal().mean(), 1e-300);
  input.gain = 0.0;
  input.value = VecX::Zero(n);
  input.sigma = VecX::Zero(n);
  input.smoother = MatX::Zero(n, n);
  MatX K(n, n);
  for (const double tau : {length / static_cast<double>(n), length / 20.0, length / 2.0})
    for (const double size : {0.1, 1.0, 10.0, 100.0, 1e3, 1e4}) {
      for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index k = 0; k < n; ++k)
          K(i, k) = size / information * std::exp(-std::abs(t[i] - t[k]) / tau);
      const MatX L = Cholesky(K).L();
      const MatX M = MatX::Identity(n, n) + L.transpose() * input.C * L;
      const Cholesky llt(M);
      const VecX Lg = L.transpose() * input.g;
      const MatX factor = llt.L();
      const double gain = Lg.dot(llt.solve(Lg)) - 2.0 * factor.diagonal().array().log().sum();
      if (!(gain > input.gain)) continue;
      input.gain = gain;
      input.smoother = L * llt.solve(MatX(L.transpose()));
      input.value = input.smoother * input.g;
      input.sigma = input.smoother.diagonal().cwiseMax(0.0).cwiseSqrt();
    }
}

double correlation(const VecX& a, const VecX& b) {
  const double norms = a.norm() * b.norm();
  return norms > 0.0 ? a.dot(b) / norms : 0.0;
}

}  // namespace

std::vector<InputEstimate> estimate_inputs(const inference::MeasuredRows& rows,
                                           const Timeline& timeline,
                                           const inference::Projector& projector,
                                           int per_position) {
  std::vector<InputEstimate> all;
  const auto bins = make_bins(timeline, per_position);
  for (const Equation equation : inference::equations_of(timeline))
    for (int axis = 0; axis < 3; ++axis) {
      InputEstimate input;
      input.equation = equation;
      input.axis = axis;
      input.bins = bins;
      MatX columns = MatX::Zero(rows.rows(), bins.size());
      VecX scale(bins.size());
      for (std::size_t k = 0; k < bins.size(); ++k) {
        // A box is felt until the next caging.
        const auto& intervals = timeline.intervals;
        const int chain = intervals[bins[k].first].chain;
        Eigen::Index first = 0;
        while (first < rows.rows() && rows.tags[first].interval < bins[k].first) ++first;
        Eigen::Index end = first;
        while (end < rows.rows() && intervals[rows.tags[end].interval].chain == chain) ++end;
        const inference::Window w{equation, axis, intervals[bins[k].first].position, bins[k].first,
                                  bins[k].second};
        columns.col(k).segment(first, end - first) =
            inference::window_signature(rows, timeline, w, first, end - first);
      }
      // Units in which the information is of order one.
      const double unit =
          std::max(columns.norm() / std::sqrt(static_cast<double>(bins.size())), 1e-300);
      columns /= unit;
      const inference::Projector::Scan s = projector.scan(columns, 0);
      input.C = s.C;
      input.g = s.g;
      input.cross = s.cross;
      smooth(input, timeline);
      input.value /= unit;
      input.sigma /= unit;
      input.smoother /= unit;  // value = smoother g, g in the scaled units
      all.push_back(std::move(input));
    }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.gain > b.gain; });
  return all;
}

RecoveredSignal recovered_signal(const InputEstimate& input, const Timeline& timeline,
                                 const std::vector<preparation::Covariate>& covariates,
                                 const std::vector<std::pair<int, double>>& cause,
                                 ShapeFrom shape) {
  RecoveredSignal out;
  out.equation = inference::equation_name(input.equation, input.axis);
  const Unit& shown = inference::unit_of(input.equation);
  out.unit = shown.symbol.view();
  const double to_si = shown.to_si;
  VecX explained;
  if (!cause.empty()) {
    VecX g = VecX::Zero(input.g.size());
    for (const auto& [column, amplitude] : cause) g += amplitude * input.cross.col(column);
    explained = input.smoother * g;
  }
  for (std::size_t k = 0; k < input.bins.size(); ++k)
    for (std::size_t i = input.bins[k].first; i < input.bins[k].second; ++i) {
      out.t.push_back(timeline.intervals[i].t1);
      out.position.push_back(timeline.intervals[i].position + 1);
      out.value.push_back(input.value[k] / to_si);
      out.sigma.push_back(input.sigma[k] / to_si);
      if (explained.size() > 0) out.explained.push_back(explained[k] / to_si);
    }

  if (shape == ShapeFrom::nothing) return out;
  if (shape != ShapeFrom::signal) {
    out.shape.kind =
        shape == ShapeFrom::cause ? Shape::Kind::of_cause : Shape::Kind::of_alternative;
    out.correlation = explained.size() > 0 ? correlation(explained, input.value) : 0.0;
    return out;
  }
  // The shape whose own projected score is largest, two-parameter ones at a discount. Of those that
  // are one but for what the model absorbs (from one recording on, or before it alone) the first.
  constexpr double better = 1.0 + 1e-6;
  double best = 0.0;
  const ShapeColumns* winner = nullptr;
  const auto all = signal_shapes(input, timeline, covariates);
  for (const ShapeColumns& f : all) {
    const MatX C = f.columns.transpose() * input.C * f.columns;
    const VecX g = f.columns.transpose() * input.g;
    if (!(C.diagonal().minCoeff() > 0.0)) continue;
    const double T = g.dot(solve_symmetric(C, g));
    const double worth = stats::strength(T, static_cast<int>(g.size()));
    if (worth > better * best) {
      best = worth;
      winner = &f;
      // Correlation of the signal with the shape, both as the test shows them.
      const VecX y = input.smoother * (input.C * f.columns * solve_symmetric(C, g));
      out.correlation = correlation(y, input.value);
    }
  }
  if (!winner) {
    out.shape.kind = Shape::Kind::nothing;
  } else if (std::abs(out.correlation) < inference::RemarkLimits::shape) {
    out.shape.kind = Shape::Kind::none_simple;
    out.correlation = 0.0;
  } else {
    out.shape = winner->shape;
  }
  return out;
}

}  // namespace drift::diagnosis
