#include "analysis/diagnosis/doubts/delay_instead.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/inference/fit_thresholds.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/preparation/recorded_test.hpp"
#include "core/estimate/batch.hpp"
#include "core/estimate/layout.hpp"

namespace drift::diagnosis {
namespace {

EstimateResult fitted(const identification::DwellsAlone& test, const FilterSpec& filter) {
  const preparation::RecordedTest laid_out =
      preparation::recorded_test(test.study, test.recordings);
  return fit_batch(filter, {laid_out.timeline, test.study.readout, laid_out.measured},
                   make_layout(filter).theta)
      .estimate;
}

/// Log evidence for the causes against the nominal model, by Laplace's method, and of so many
/// effects of the library as likely as another each.
double log_weight_of_causes(const identification::DwellsAlone& test, const Diagnosis& d) {
  std::size_t visible = 0;
  for (const search::CandidateScore& c : d.candidates) visible += c.dof > 0 ? 1 : 0;
  const double one_effect = std::log(inference::PosteriorPrior::library /
                                     static_cast<double>(std::max<std::size_t>(1, visible)));
  const EstimateResult nominal = fitted(test, d.nominal), with = fitted(test, d.patched);
  double log_weight =
      0.5 * (nominal.statistic - with.statistic) / std::max(1.0, with.statistic_per_dof());
  for (const ParameterEstimate& p : with.parameters)
    if (!d.nominal.active[p.param] && p.sigma > 0.0 && p.prior_sigma > p.sigma)
      log_weight += std::log(p.sigma / p.prior_sigma);
  const auto together = std::ranges::count(d.causes, d.causes.front().set, &search::Cause::set);
  return log_weight + static_cast<double>(together) * one_effect;
}

/// timing_skew is such a delay: of a usual size it has that name.
bool is_skew(const Diagnosis& d) {
  return std::ranges::any_of(d.causes, [](const search::Cause& c) {
    return c.term == "timing_skew" && c.size_sigma <= inference::FitLimits::beyond_prior;
  });
}

}  // namespace

std::optional<remark::DelayInstead> delay_instead(const mc::Study& study,
                                                  const std::vector<Recording>& recordings,
                                                  const std::vector<Recording>& recorded,
                                                  const Diagnosis& d) {
  if (d.of_case || is_skew(d)) return std::nullopt;
  if (d.verdict == Verdict::consistent && !(d.fit.chi2_per_dof_before > d.fit.band_high))
    return std::nullopt;
  const auto test = identification::dwells_alone(study, recordings);
  if (!test) return std::nullopt;
  const auto delay =
      identification::delay_of_misfit(*test, d.nominal, identification::usual_interval(recorded));
  if (!delay) return std::nullopt;
  remark::DelayInstead out{*delay};
  if (!d.causes.empty() && d.has_patch)
    out.odds = std::exp(delay->log_evidence + std::log(inference::SiteLimits::another) -
                        log_weight_of_causes(*test, d));
  return out;
}

Diagnosis with_delay(Diagnosis d, const remark::DelayInstead& delay) {
  constexpr double credible = inference::SearchLimits::credible;
  if (d.verdict == Verdict::named && delay.odds * credible > 1.0 - credible)
    d.verdict = Verdict::ambiguous;
  d.remarks.emplace_back(delay);
  return d;
}

}  // namespace drift::diagnosis
