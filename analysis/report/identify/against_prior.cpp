#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/report/identify/sections.hpp"
#include "analysis/report/svg/dumbbell_chart.hpp"
#include "analysis/report/svg/figure.hpp"
#include "core/physics/stochastic.hpp"

namespace drift::report {
namespace {

constexpr std::size_t most_lines = 24;

/// The states to show, in their order: all, or those of which most was learned.
std::vector<std::size_t> shown_states(const FilterView& v, const EstimateResult& found) {
  std::vector<std::size_t> states(v.summary.layout.size());
  std::iota(states.begin(), states.end(), std::size_t{0});
  if (states.size() <= most_lines) return states;
  std::ranges::stable_sort(states, {},
                           [&](std::size_t k) { return found.parameters[k].learning_ratio(); });
  states.resize(most_lines);
  std::ranges::sort(states);
  return states;
}

}  // namespace

Section against_prior(const FilterView& v) {
  const EstimateResult& found = judged(v);
  if (found.parameters.size() != v.summary.layout.size()) return {};
  DumbbellChart chart;
  chart.title = fmt::format("Estimates of filter {} against {}", v.spec().name,
                            v.id.truth ? "the truth" : "the prior");
  chart.x_label = "distance from the prior's mean [prior sigma]";
  chart.before_label = v.id.truth ? "truth" : "prior mean";
  chart.after_label = "estimate, 95 % interval";
  chart.text_label = "estimate ± 1 sigma, verdict";
  const std::vector<std::size_t> states = shown_states(v, found);
  for (const std::size_t k : states) {
    const std::size_t param = v.summary.layout.params[k];
    const ParameterEstimate& p = found.parameters[k];
    const double prior = v.summary.layout.sigma[k], mean = v.summary.layout.mean[k];
    const auto scaled = [&](double value) { return (value - mean) / prior; };
    if (!(prior > 0.0) || !std::isfinite(p.value)) continue;
    chart.lines.push_back(
        {.label = parameter_key(param),
         .before = v.id.truth ? scaled(v.id.truth->theta[param]) : 0.0,
         .after = scaled(p.value),
         .low = scaled(p.value - 1.96 * p.sigma),
         .high = scaled(p.value + 1.96 * p.sigma),
         .text = fmt::format("{} {}, {}",
                             with_sigma(p.value / unit_of(param), p.sigma / unit_of(param)),
                             parameter_unit(param), verdict_cell(verdict_of(v, k)).text)});
  }
  if (chart.lines.empty()) return {};
  const std::size_t others = v.summary.layout.size() - states.size();
  return {"",
          {figure_of(
              std::move(chart),
              fmt::format("Estimates of {} from start {}; an axis from -2 to 2 holds 95 % of what "
                          "the prior expects.{}",
                          drift_varies(v.spec()) ? "the EKF" : "the batch fit",
                          v.id.counted(v.summary).start + 1,
                          others > 0 ? fmt::format(" Of {} parameters less is learned: they are "
                                                   "in the table below.",
                                                   others)
                                     : ""))}};
}

}  // namespace drift::report
