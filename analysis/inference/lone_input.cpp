#include "analysis/inference/lone_input.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/inference/projector.hpp"
#include "analysis/inference/scan.hpp"
#include "core/stats/chi_square.hpp"

namespace drift::inference {
namespace {

using Equation = LoneInput::Equation;

constexpr double forever = std::numeric_limits<double>::infinity();
constexpr double deg_per_h = detail::deg / 3600.0;  // [rad/s]

/// One kind of input, and a size at which it may begin to matter, SI.
struct Kind {
  Equation equation;
  double tau, reference;
};

std::vector<Kind> kinds_of(const LinearProblem& problem) {
  std::vector<Kind> all{{Equation::rate, forever, 1e-3 * deg_per_h / 60.0},
                        {Equation::rate, 900.0, 1e-3 * deg_per_h},
                        {Equation::rate, 3600.0, 1e-3 * deg_per_h}};
  const auto read = [&](bool accelerometer) {
    return std::any_of(problem.tags.begin(), problem.tags.end(),
                       [&](auto& t) { return t.accelerometer() == accelerometer; });
  };
  for (const double tau : {300.0, 1800.0}) {
    if (read(true)) all.push_back({Equation::accelerometer, tau, 0.05 * problem.acc_sigma});
    if (read(false)) all.push_back({Equation::gimbal, tau, 0.05 * problem.gimbal_sigma});
  }
  return all;
}

Window::Equation of_window(Equation e) {
  return e == Equation::rate            ? Window::Equation::rate
         : e == Equation::accelerometer ? Window::Equation::accelerometer
                                        : Window::Equation::gimbal;
}

}  // namespace

LoneEffect strongest_lone_input(const LinearProblem& problem, const NoiseModel& noise,
                                const std::vector<int>& with) {
  LinearProblem bare = problem;
  const Eigen::Index n = problem.theta.cols();
  bare.extra.resize(problem.rows(), 0);
  bare.theta.conservativeResize(Eigen::NoChange, n + with.size());
  for (std::size_t k = 0; k < with.size(); ++k) bare.theta.col(n + k) = problem.extra.col(with[k]);
  const auto value = [&](const LoneInput& input) {
    NoiseModel m = noise;
    m.lone = input;
    return Projector(bare, m).candidates().log_likelihood2();
  };
  const double base = value({});
  LoneEffect best;
  std::size_t tries = 0;
  for (const Kind& kind : kinds_of(problem))
    for (int axis = 0; axis < 3; ++axis) {
      ++tries;
      LoneInput input{kind.equation, axis, kind.reference, kind.tau};
      // Up a ladder from where hardly anything is changed, until it gets worse again.
      constexpr double rung = 3.0;
      double last = 0.0;
      for (int k = 0; k < 7; ++k, input.sigma *= rung) {
        const double gain = value(input) - base;
        if (gain > best.gain) best = {input, gain, 1.0, {}};
        if (gain < last - 0.5) break;
        last = gain;
      }
    }
  if (best.gain <= 0.0) return best;
  // Between the rungs.
  const LoneInput rung_best = best.input;
  for (const double factor : {0.58, 0.76, 1.32, 1.73}) {
    LoneInput input = rung_best;
    input.sigma *= factor;
    if (const double gain = value(input) - base; gain > best.gain) best = {input, gain, 1.0, {}};
  }
  best.p_value =
      std::min(1.0, 0.5 * static_cast<double>(tries) * std::exp(stats::log_tail(best.gain, 1.0)));
  best.equation = equation_name(of_window(best.input.equation), best.input.axis);
  return best;
}

}  // namespace drift::inference
