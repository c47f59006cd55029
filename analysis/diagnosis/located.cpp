#include "analysis/diagnosis/located.hpp"

#include <algorithm>

#include "analysis/diagnosis/locate.hpp"
#include "analysis/search/explained.hpp"

namespace drift::diagnosis {
namespace {

constexpr int bins_per_position = 6;
constexpr std::size_t most_signals = 2, most_windows = 8;

std::string equation_of(const Judged& judged, const std::vector<InputEstimate>& inputs,
                        const inference::Window* window) {
  using Equation = inference::Equation;
  if (judged.one_gyro) return inference::equation_name(Equation::rate, judged.one_gyro->axis);
  if (judged.verdict == Verdict::consistent) return "";
  if (!inputs.empty() && inputs.front().gain > 0.0)
    return inference::equation_name(inputs.front().equation, inputs.front().axis);
  return window ? inference::equation_name(window->equation, window->axis) : "";
}

}  // namespace

inference::NoiseModel noise_without_effect(const search::Fitted& nominal,
                                           const search::Search& found) {
  if (found.significant) return nominal.noise.model;
  inference::NoiseModel white = search::declared_noise(nominal.filter);
  white.acc_factor = nominal.noise.model.acc_factor;
  white.gimbal_factor = nominal.noise.model.gimbal_factor;
  return white;
}

Located located(const search::Fitted& nominal, const search::Search& found, const Judged& judged,
                const Timeline& timeline, const std::vector<preparation::Covariate>& covariates,
                Signals signals) {
  const search::Refit* best = found.sets.empty() ? nullptr : &found.sets.front();
  // What the cause explains, by the refit: what it takes out of the residuals.
  inference::LinearProblem shown = nominal.problem.bare();
  shown.extra.resize(shown.rows(), best ? 1 : 0);
  std::vector<std::pair<int, double>> cause;
  if (best) {
    shown.extra.col(0) = search::taken_out(nominal.problem, nominal.filter, nominal.fit,
                                           best->filter, best->after.fit);
    cause.emplace_back(0, 1.0);
  }
  std::vector<InputEstimate> inputs;
  if (signals == Signals::recovered && judged.verdict != Verdict::consistent)
    inputs = estimate_inputs(shown, timeline,
                             inference::Projector(shown, noise_without_effect(nominal, found)),
                             bins_per_position);

  const inference::Window* window = strongest_window(nominal);
  VecX signature = VecX::Zero(nominal.problem.rows());
  if (best)
    signature = signature_of(inference::Projector(shown, nominal.noise.model), cause);
  else if (window)
    signature = signature_of(nominal.problem, timeline, *nominal.projector, *window);
  Located out{locate(nominal, found.thresholds, signature, most_windows), {}};
  out.where.equation = equation_of(judged, inputs, window);
  for (std::size_t k = 0; k < std::min(most_signals, inputs.size()); ++k)
    out.signals.push_back(recovered_signal(inputs[k], timeline, covariates, cause));
  return out;
}

}  // namespace drift::diagnosis
