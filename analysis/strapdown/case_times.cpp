#include "analysis/strapdown/case_times.hpp"

#include "analysis/diagnosis/doubts/site_doubt.hpp"
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
  const auto fitted_at = [&](double factor, const BatchOptions& how, const auto& told) {
    const CaseTest test = retimed(id.study.test, factor);
    const MeasuredTest measured{test.timeline, test.readout, test.measured};
    return told(measured, fit_batch_from(filter, measured, start, declared.psi0_l, how));
  };
  const identification::FitAtTimes as_declared = [&](double factor) {
    return fitted_at(factor, options, [&](const MeasuredTest& test, const BatchResult& fit) {
      return under_walk(filter, test, fit);
    });
  };
  const identification::FitAtTimes as_found = [&](double factor) {
    return fitted_at(factor, {}, [&](const MeasuredTest& test, const BatchResult& fit) {
      return under_noise(filter, test, fit, *d.driving_noise);
    });
  };
  const auto clock_of = [](const identification::FitAtTimes& fit) -> diagnosis::ClockOfMisfit {
    return [&fit](double promised) { return identification::clock_of_misfit(fit, promised); };
  };
  const auto times = diagnosis::times_instead(clock_of(as_declared), d,
                                              d.driving_noise ? clock_of(as_found) : nullptr);
  if (!times) return;
  if (d.verdict == diagnosis::Verdict::named) d.verdict = diagnosis::Verdict::ambiguous;
  d.remarks.emplace_back(*times);
}

}  // namespace drift::strapdown
