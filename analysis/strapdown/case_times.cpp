#include "analysis/strapdown/case_times.hpp"

#include "analysis/diagnosis/doubts/site_doubt.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/search/fitted.hpp"
#include "analysis/strapdown/walking_drift.hpp"
#include "core/estimate/strapdown/retimed.hpp"

namespace drift::strapdown {

void take_times(diagnosis::Diagnosis& d, const CaseIdentification& id, const FilterSpec& nominal) {
  if (d.wrong_study()) return;
  const FilterSpec filter = case_filter(nominal, id.study);
  const BatchResult& declared = id.fits.front().fit;
  const Theta start = theta_of(filter, declared);
  // What under_walk() makes of a fit it has from the whole of it.
  const bool walks = search::declared_noise(filter).drift_random_walk != 0.0;
  const BatchOptions options{.result = walks ? BatchOptions::Result::whole
                                             : BatchOptions::Result::estimates};
  const auto at = [&](double factor) {
    const CaseTest test = retimed(id.study.test, factor);
    const MeasuredTest measured{test.timeline, test.readout, test.measured};
    return under_walk(filter, measured,
                      fit_batch_from(filter, measured, start, declared.psi0_l, options));
  };
  const auto times = diagnosis::times_instead(
      [&](double promised) { return identification::clock_of_misfit(at, promised); }, d);
  if (!times) return;
  constexpr double credible = inference::SearchLimits::credible;
  if (d.verdict == diagnosis::Verdict::named && times->odds * credible > 1.0 - credible)
    d.verdict = diagnosis::Verdict::ambiguous;
  d.remarks.emplace_back(*times);
}

}  // namespace drift::strapdown
