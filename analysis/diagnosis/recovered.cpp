#include "analysis/diagnosis/recovered.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace drift::diagnosis {
namespace {

using Equation = inference::Window::Equation;

constexpr double worth_saying = 0.3;  // correlation of a shape below which it says nothing

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

double middle_time(const Timeline& t, const std::pair<std::size_t, std::size_t>& bin) {
  return 0.5 * (t.intervals[bin.first].t0 + t.intervals[bin.second - 1].t1);
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
      const MatX L = Eigen::LLT<MatX>(K).matrixL();
      const MatX M = MatX::Identity(n, n) + L.transpose() * input.C * L;
      const Eigen::LLT<MatX> llt(M);
      const VecX Lg = L.transpose() * input.g;
      const MatX factor = llt.matrixL();
      const double gain = Lg.dot(llt.solve(Lg)) - 2.0 * factor.diagonal().array().log().sum();
      if (!(gain > input.gain)) continue;
      input.gain = gain;
      input.smoother = L * llt.solve(L.transpose());
      input.value = input.smoother * input.g;
      input.sigma = input.smoother.diagonal().cwiseMax(0.0).cwiseSqrt();
    }
}

/// A shape that the signal may have, bin by bin.
struct Feature {
  std::string text;
  MatX columns;  ///< shape (bins, 1 or 2)
  double onset = -1.0, period = -1.0;
  std::string covariate;
};

std::vector<Feature> features(const InputEstimate& input, const Timeline& timeline,
                              const std::vector<Covariate>& covariates) {
  const auto n = static_cast<Eigen::Index>(input.bins.size());
  std::vector<Feature> all;
  VecX t(n), in_position(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    t[k] = middle_time(timeline, input.bins[k]);
    std::size_t start = input.bins[k].first;
    const int position = timeline.intervals[start].position;
    while (start > 0 && timeline.intervals[start - 1].position == position) --start;
    in_position[k] = t[k] - timeline.intervals[start].t0;
  }
  const double t0 = timeline.intervals.front().t0, length = timeline.intervals.back().t1 - t0;
  const auto add = [&](std::string text, const VecX& v) {
    all.push_back({std::move(text), v, -1.0, -1.0, {}});
  };
  add("grows evenly with time", (t.array() - t0) / length);
  for (const double tau : {600.0, 1800.0, 3600.0, 7200.0, 14400.0}) {
    if (tau < length)
      add(fmt::format(
              "dies away from the start of the test with a time constant of about {:.0f} min",
              tau / 60.0),
          (-(t.array() - t0) / tau).exp());
    if (tau < 3600.0)
      add(fmt::format("dies away within every position with a time constant of about {:.0f} min",
                      tau / 60.0),
          (-in_position.array() / tau).exp());
  }
  for (Eigen::Index k = 1; k < n; ++k) {
    Feature f{"",
              (t.array() >= t[k]).cast<double>().matrix(),
              timeline.intervals[input.bins[k].first].t0,
              -1.0,
              {}};
    f.text = fmt::format("sets in at {:.0f} s and stays", f.onset);
    all.push_back(f);
  }
  for (int cycles = 1; cycles <= n / 4; ++cycles) {
    const double period = 2.0 * length / static_cast<double>(cycles + 1);
    MatX two(n, 2);
    two.col(0) = (t.array() * (2.0 * std::numbers::pi / period)).cos();
    two.col(1) = (t.array() * (2.0 * std::numbers::pi / period)).sin();
    all.push_back({fmt::format("swings with a period of about {:.1f} h", period / 3600.0),
                   two,
                   -1.0,
                   period,
                   {}});
  }
  // What the platform feels: specific force along its axes, and products.
  MatX a(n, 3);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto middle =
        timeline.intervals[(input.bins[k].first + input.bins[k].second - 1) / 2].middle_node();
    a.row(k) = timeline.nodes[middle].R_lr.row(2);
  }
  for (int i = 0; i < 3; ++i) {
    add(fmt::format("goes with the specific force along {}", "xyz"[i]), a.col(i));
    for (int j = 0; j <= i; ++j)
      add(fmt::format("goes with the product of specific forces along {} and {}", "xyz"[j],
                      "xyz"[i]),
          a.col(i).cwiseProduct(a.col(j)));
  }
  std::vector<int> seen;
  for (const auto& bin : input.bins) {
    const int position = timeline.intervals[bin.first].position;
    if (std::find(seen.begin(), seen.end(), position) != seen.end()) continue;
    seen.push_back(position);
    VecX v(n);
    for (Eigen::Index k = 0; k < n; ++k)
      v[k] = timeline.intervals[input.bins[k].first].position == position;
    add(fmt::format("is present in position {} alone", position + 1), v);
  }
  for (const Covariate& c : covariates) {
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
    if (v.norm() > 0.0)
      all.push_back({fmt::format("goes with the recorded {}", c.name), v, -1.0, -1.0, c.name});
  }
  return all;
}

}  // namespace

std::vector<InputEstimate> estimate_inputs(const inference::LinearProblem& problem,
                                           const Timeline& timeline,
                                           const inference::Projector& projector,
                                           int per_position) {
  std::vector<InputEstimate> all;
  const auto bins = make_bins(timeline, per_position);
  for (const Equation equation :
       {Equation::rate, Equation::attitude, Equation::accelerometer, Equation::gimbal})
    for (int axis = 0; axis < 3; ++axis) {
      InputEstimate input;
      input.equation = equation;
      input.axis = axis;
      input.bins = bins;
      MatX columns = MatX::Zero(problem.rows(), bins.size());
      VecX scale(bins.size());
      for (std::size_t k = 0; k < bins.size(); ++k) {
        // A box is felt until the next caging.
        const auto& intervals = timeline.intervals;
        const int chain = intervals[bins[k].first].chain;
        Eigen::Index first = 0;
        while (first < problem.rows() && problem.tags[first].interval < bins[k].first) ++first;
        Eigen::Index end = first;
        while (end < problem.rows() && intervals[problem.tags[end].interval].chain == chain) ++end;
        const inference::Window w{equation, axis, intervals[bins[k].first].position, bins[k].first,
                                  bins[k].second};
        columns.col(k).segment(first, end - first) =
            inference::window_signature(problem, timeline, w, first, end - first);
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
                                 const std::vector<Covariate>& covariates,
                                 const std::vector<std::pair<int, double>>& cause) {
  RecoveredSignal out;
  out.equation = inference::equation_name(input.equation, input.axis);
  const bool rate = input.equation == Equation::rate,
             acc = input.equation == Equation::accelerometer;
  out.unit = rate ? "deg/h" : acc ? "ug" : "arcsec";
  const double to_si = rate || !acc ? detail::deg / 3600.0 : 1e-6;
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

  // The shape whose own projected score is largest, two-parameter ones at a discount.
  double best = 0.0;
  const Feature* winner = nullptr;
  const auto all = features(input, timeline, covariates);
  for (const Feature& f : all) {
    const MatX C = f.columns.transpose() * input.C * f.columns;
    const VecX g = f.columns.transpose() * input.g;
    if (!(C.diagonal().minCoeff() > 0.0)) continue;
    const double T = g.dot(C.ldlt().solve(g));
    const double worth = stats::strength(T, static_cast<int>(g.size()));
    if (worth > best) {
      best = worth;
      winner = &f;
      // Correlation of the signal with the shape, both as the test shows them.
      const VecX y = input.smoother * (input.C * f.columns * C.ldlt().solve(g));
      out.correlation = y.norm() > 0.0 && input.value.norm() > 0.0
                            ? y.dot(input.value) / (y.norm() * input.value.norm())
                            : 0.0;
    }
  }
  if (winner && std::abs(out.correlation) < worth_saying) {
    out.shape = fmt::format(
        "{}: of no simple shape: several effects, or many parameters, may be missing at once",
        out.equation);
    out.correlation = 0.0;
  } else if (winner) {
    out.shape =
        fmt::format("{}: {} (correlation {:.2f})", out.equation, winner->text, out.correlation);
    out.onset_s = winner->onset;
    out.period_s = winner->period;
    out.best_covariate = winner->covariate;
  } else {
    out.shape = fmt::format("{}: nothing above the noise", out.equation);
  }
  return out;
}

}  // namespace drift::diagnosis
