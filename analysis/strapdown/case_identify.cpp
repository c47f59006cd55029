#include "analysis/strapdown/case_identify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "analysis/strapdown/case_latitude.hpp"
#include "analysis/strapdown/sensed.hpp"
#include "analysis/strapdown/walking_drift.hpp"
#include "core/base/check.hpp"
#include "core/base/nan.hpp"
#include "mc/study/own_terms_check.hpp"

namespace drift::strapdown {
namespace {

void check(const mc::Study& study) {
  std::vector<std::string> problems;
  if (study.filters.empty())
    problems.push_back(
        fmt::format("{}: no [[filter]] (a coupling eq5 or eq6 is expected). Add a "
                    "section [[filter]] with name, coupling and terms",
                    study.path));
  for (const FilterSpec& f : study.filters)
    if (!facts(f.coupling).other)
      problems.push_back(
          fmt::format("{}: [[filter]] '{}' of a strapdown plan has coupling {} "
                      "(eq5 or eq6 is expected: gyros on the case have no servo "
                      "loop). Choose one of the two",
                      study.path, f.name, key_of(f.coupling)));
  if (!problems.empty()) throw InputError(ExitCode::config, std::move(problems));
}

}  // namespace

CaseIdentification identify_case(const mc::Study& study, CaseStudy of) {
  mc::require_own_terms(study);
  check(study);
  CaseIdentification out;
  out.study = std::move(of);
  out.division = division_of(out.study);
  out.seed = study.monte_carlo.seed;
  const EarthRate earth = out.study.compass.sees_earth ? EarthRate::seen : EarthRate::hidden;
  for (const FilterSpec& filter : study.filters) {
    const FilterSpec seen = case_filter(filter, out.study);
    BatchResult fit = fit_batch(seen, out.study.measured(), start_of(seen, out.study));
    CaseScores scores = scores_of(seen, fit, out.study, out.division, out.seed);
    std::vector<InstrumentFit> instruments = instrument_fits(seen, out.study.measured(), fit);
    fit.estimate = under_walk(seen, out.study.measured(), fit);
    out.fits.push_back({findings_of(as_sensed(fit.estimate), earth), std::move(scores), filter.name,
                        filter.coupling, fit, std::move(instruments)});
  }
  out.eq5_gain = nan_value;
  const auto with = [&](Coupling equation) {
    return std::ranges::find(out.fits, equation, &CaseFit::equation);
  };
  const auto five = with(Coupling::eq5), six = with(Coupling::eq6);
  if (out.division.folds > 0 && five != out.fits.end() && six != out.fits.end())
    out.eq5_gain = paired_gain(six->up.errors, five->up.errors);
  return out;
}

CaseIdentification identify_case(const mc::Study& study, const Recording& recording) {
  CaseIdentification out = identify_case(study, case_study(study, recording));
  out.latitude = latitude_doubt(study, recording, out);
  return out;
}

}  // namespace drift::strapdown
