#include <algorithm>
#include <cmath>

#include "analysis/report/identify/sections.hpp"
#include "analysis/report/svg/axis_scale.hpp"
#include "core/estimate/start_consistency.hpp"
#include "core/stats/chi_square_band.hpp"

namespace drift::report {
namespace {

/// Parameters that the two estimators, given the same, see differently: further apart than five of
/// the smaller sigma, or with sigmas that differ threefold. Empty if one failed, or if the model is
/// wrong for both.
std::vector<std::string> disputed(const identification::FilterRun& run) {
  constexpr double apart = 5.0, unlike = 3.0;
  const EstimateResult& fit = run.batch.estimate;
  std::vector<std::string> keys;
  if (run.ekf.status != EstimateStatus::ok || fit.status != EstimateStatus::ok || misfit(fit))
    return keys;
  for (std::size_t k = 0; k < run.ekf.parameters.size(); ++k) {
    const ParameterEstimate &e = run.ekf.parameters[k], &b = fit.parameters[k];
    const auto [less, more] = std::minmax(e.sigma, b.sigma);
    if (std::abs(e.value - b.value) > apart * less || more > unlike * less)
      keys.push_back(parameter_key(e.param));
  }
  return keys;
}

std::string start_sentence(const FilterView& v) {
  std::vector<std::string> dependent;
  for (const identification::StartSpread& p : v.summary.spread)
    if (start_verdict(p.ekf) == StartVerdict::depends_on_start)
      dependent.push_back(parameter_key(p.param));
  if (dependent.empty()) return "no parameter depends on the start.";
  return fmt::format(
      "{} of {} parameters depend on the start, their sigmas say nothing of their errors: {}.",
      dependent.size(), v.summary.spread.size(), fmt::join(dependent, ", "));
}

std::string nis_sentence(const std::vector<const identification::FilterRun*>& runs) {
  std::size_t outside = 0;
  Range nis;
  for (const identification::FilterRun* run : runs) {
    if (run->ekf.measured == 0) continue;
    const double per_dof = run->ekf.statistic_per_dof();
    nis.include(per_dof);
    outside += !stats::chi_square_band(static_cast<double>(run->ekf.measured)).holds(per_dof);
  }
  if (nis.empty()) return "";
  return fmt::format("EKF NIS/m {:.3f} to {:.3f}, {}.", nis.low, nis.high,
                     outside == 0 ? "inside the 95 % band of a right model"
                                  : fmt::format("outside the 95 % band of a right model from {} "
                                                "of {} starts",
                                                outside, runs.size()));
}

std::string dispute_sentence(const FilterView& v, const identification::FilterRun& run) {
  constexpr std::size_t most = 8;
  std::vector<std::string> keys = disputed(run);
  const std::size_t count = keys.size();
  // With process noise the two answer different questions.
  if (count == 0 || v.spec().noise.any()) return "";
  keys.resize(std::min(count, most));
  return fmt::format(
      "from start 1, EKF and batch fit are more than five sigma apart, or claim sigmas that differ "
      "threefold, in {} of {} parameters: {}{}. The EKF linearises once, where it is then; what is "
      "not linear over its prior leads it astray with a small sigma. Use the batch column.",
      count, v.summary.spread.size(), fmt::join(keys, ", "), count > most ? " and others" : "");
}

std::vector<std::string> sentences_of(const FilterView& v) {
  const auto runs = v.id.runs_of(v.summary.filter);
  const auto failed = std::ranges::count_if(runs, [](const identification::FilterRun* run) {
    return run->ekf.status != EstimateStatus::ok ||
           run->batch.estimate.status != EstimateStatus::ok;
  });
  std::vector<std::string> said;
  if (v.spec().noise.any())
    said.push_back(
        "declares process noise, which the batch fit does not model: its sigmas and `left` are too "
        "small; use the EKF's.");
  if (failed > 0)
    said.push_back(fmt::format("{} of {} starts failed or did not converge.", failed, runs.size()));
  if (runs.size() > 1) said.push_back(start_sentence(v));
  said.push_back(nis_sentence(runs));
  said.push_back(dispute_sentence(v, *runs.front()));
  if (!v.summary.degeneracies.empty())
    said.push_back(
        fmt::format("{} combinations of its {} parameters cannot be seen in this test at all.",
                    v.summary.degeneracies.size(), v.summary.layout.size()));
  std::erase(said, "");
  return said;
}

}  // namespace

std::vector<std::string> headlines(const mc::Study& study,
                                   const identification::Identification& id) {
  std::vector<std::string> all;
  for (const identification::FilterSummary& s : id.summaries) {
    const FilterView view{study, id, s};
    for (const std::string& said : sentences_of(view))
      all.push_back(fmt::format("Filter {}: {}", view.name(), said));
  }
  return all;
}

}  // namespace drift::report
