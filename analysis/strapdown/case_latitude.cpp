#include "analysis/strapdown/case_latitude.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/inference/thresholds.hpp"
#include "analysis/strapdown/walking_drift.hpp"
#include "core/stats/chi_square_band.hpp"

namespace drift::strapdown {
namespace {

using identification::LatitudeDoubt;
using inference::SiteLimits;

constexpr auto d_lat = TermLibrary::index("d_lat");

/// What gyros may be off by in scale and still be said to see the Earth, beside their noise.
constexpr double scale = 0.02;
/// Of the Earth's rate: of gyros that know it less well anything may make it whole.
constexpr double best_known = 0.1;

/// The Earth as the gyros see it, laid out anew at its latitude until that stands.
std::optional<EarthSeen> earth_of(const mc::Study& study, const Recording& recording,
                                  const DwellSearch& search) {
  constexpr int rounds = 6;
  constexpr double stands = 0.01;  // of its sigma
  Recording measured = recording;
  std::vector<std::string> said_before;
  leave_out_not_measured(measured, said_before);
  const Signals signals = signals_of(measured);
  Site site = study.site;
  EarthSeen seen;
  for (int round = 0; round < rounds; ++round) {
    const CaseTest test = lay_out_case(signals, search.dwells, site, Carry::through, seen.azimuth);
    seen = earth_seen(test, seen.azimuth, drift_prior(study));
    if (!(seen.sigma_rate < best_known * detail::earth_rate)) return std::nullopt;
    const double moved = std::abs(seen.latitude - site.latitude);
    site.latitude = seen.latitude;
    if (moved < stands * seen.sigma) break;
  }
  const double off = std::abs(seen.rate - detail::earth_rate);
  if (off > 3.0 * seen.sigma_rate + scale * detail::earth_rate) return std::nullopt;
  return seen;
}

/// The first filter fitted where the test is laid out, with what is left of the latitude's error;
/// empty far from where that was linearised: such a fit is of something else. id: of the declared
/// latitude; `of` may be its own layout.
std::optional<LatitudeDoubt> fitted_at(double latitude, const mc::Study& study, const CaseStudy& of,
                                       const CaseIdentification& id) {
  const BatchResult& declared = id.fits.front().fit;
  const EstimateResult& before = declared.estimate;
  FilterSpec filter = case_filter(study.filters.front(), of);
  filter.active.set(d_lat);
  filter.priors[d_lat] = normal(0.0, SiteLimits::bent_deg * unit::deg.to_si);
  const EstimateResult after = under_walk(  // as identify_case() has the other
      filter, of.measured(),
      &of == &id.study
          ? fit_batch_from(filter, of.measured(), theta_of(filter, declared), declared.psi0_l)
          : fit_batch(filter, of.measured(), start_of(filter, of)));
  const ParameterEstimate* rest = after.find(d_lat);
  if (rest == nullptr || std::abs(rest->value) > 2.0 * filter.priors[d_lat].sigma())
    return std::nullopt;
  LatitudeDoubt doubt;
  doubt.latitude = latitude + rest->value;
  doubt.declared = study.site.latitude;
  doubt.sigma = rest->sigma;
  doubt.chi2_per_dof_before = before.statistic_per_dof();
  doubt.chi2_per_dof_after = after.statistic_per_dof();
  doubt.chance_after =
      stats::misfit_chance(doubt.chi2_per_dof_after, static_cast<double>(after.measured));
  doubt.weigh((before.statistic - after.statistic) / std::max(1.0, doubt.chi2_per_dof_after));
  return doubt;
}

}  // namespace

std::optional<LatitudeDoubt> latitude_doubt(const mc::Study& study, const Recording& recording,
                                            const CaseIdentification& id) {
  if (study.filters.front().active[d_lat]) return std::nullopt;
  // Where the gyros see the Earth as the study has it the two layouts are of one model.
  const bool comparable = id.study.compass.sees_earth;
  if (comparable)
    if (const auto here = fitted_at(study.site.latitude, study, id.study, id);
        here && !here->evident())
      return std::nullopt;
  const auto seen = earth_of(study, recording, id.study.search);
  if (!seen) return std::nullopt;
  mc::Study there = study;
  there.site.latitude = seen->latitude;
  const CaseStudy of = case_study(there, recording);
  if (!of.compass.sees_earth) return std::nullopt;
  auto doubt = fitted_at(seen->latitude, study, of, id);
  if (!doubt) return std::nullopt;
  if (!comparable) {
    const double off = (doubt->latitude - doubt->declared) / seen->sigma;
    doubt->weigh(off * off);
  }
  if (!doubt->evident() || (comparable && !doubt->explains())) return std::nullopt;
  doubt->mirrored = doubt->is_on_other_hemisphere();
  return doubt;
}

}  // namespace drift::strapdown
