#include "analysis/inference/noise/lone_input.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/inference/marginal.hpp"
#include "analysis/inference/noise/sigma_ladder.hpp"
#include "core/base/units.hpp"
#include "core/stats/chi_square.hpp"

namespace drift::inference {
namespace {

constexpr double forever = std::numeric_limits<double>::infinity();
constexpr double deg_per_h = unit::deg_per_h.to_si;

/// One kind of input, and a size at which it may begin to matter, SI.
struct Kind {
  Equation equation;
  double tau, reference;
};

std::vector<Kind> kinds_of(const LinearProblem& problem) {
  std::vector<Kind> all{{Equation::rate, forever, 1e-3 * unit::deg_per_h_per_sqrt_h.to_si},
                        {Equation::rate, 900.0, 1e-3 * deg_per_h},
                        {Equation::rate, 3600.0, 1e-3 * deg_per_h}};
  constexpr double still = LoneInput::constant;
  const bool several = std::ranges::count(problem.drives, true, &IntervalDrive::begins) > 1;
  if (several) all.push_back({Equation::rate, still, 1e-3 * deg_per_h});
  const auto read = [&](bool accelerometer) {
    return std::any_of(problem.tags.begin(), problem.tags.end(),
                       [&](auto& t) { return t.accelerometer() == accelerometer; });
  };
  const bool of_case = std::ranges::any_of(problem.drives, &IntervalDrive::rest);
  for (const double tau : {300.0, 1800.0, still}) {
    if (tau == still && !several) continue;
    if (read(true)) all.push_back({Equation::accelerometer, tau, 0.05 * problem.acc_sigma});
    if (read(false) && !of_case)
      all.push_back({Equation::gimbal, tau, 0.05 * problem.gimbal_sigma});
  }
  return all;
}

}  // namespace

LoneEffect strongest_lone_input(const LinearProblem& problem, const NoiseModel& noise,
                                const std::vector<int>& in_mean) {
  constexpr int rungs = 7;
  constexpr double drop = 0.5;
  const MarginalLikelihood likelihood(problem, in_mean);
  const auto value = [&](const LoneInput& input) {
    NoiseModel m = noise;
    m.lone = input;
    return likelihood.log_likelihood2(m);
  };
  const double base = value({});
  const std::vector<Kind> kinds = kinds_of(problem);
  LoneEffect best;
  for (const Kind& kind : kinds)
    for (int axis = 0; axis < 3; ++axis) {
      LoneInput input{kind.equation, axis, 0.0, kind.tau};
      const Rung top = climb(kind.reference, rungs, drop, [&](double sigma) {
        input.sigma = sigma;
        return value(input) - base;
      });
      input.sigma = top.sigma;
      if (top.gain > best.gain) best = {input, top.gain, 1.0, {}};
    }
  if (best.gain <= 0.0) return best;
  const LoneInput on_rung = best.input;
  for (const double between : {0.58, 0.76, 1.32, 1.73}) {
    LoneInput input = on_rung;
    input.sigma *= between;
    if (const double gain = value(input) - base; gain > best.gain) best = {input, gain, 1.0, {}};
  }
  const double tries = 3.0 * static_cast<double>(kinds.size());
  best.p_value = std::min(1.0, 0.5 * tries * std::exp(stats::log_tail(best.gain, 1.0)));
  best.equation = equation_name(best.input.equation, best.input.axis);
  return best;
}

}  // namespace drift::inference
