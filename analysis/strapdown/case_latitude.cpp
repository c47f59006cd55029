#include "analysis/strapdown/case_latitude.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/inference/thresholds.hpp"
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
  const Signals signals = signals_of(recording);
  Site site = study.site;
  std::vector<double> azimuth;
  std::optional<EarthSeen> seen;
  for (int round = 0; round < rounds; ++round) {
    const CaseTest test = lay_out_case(signals, search.dwells, site, Carry::through, azimuth);
    seen = earth_seen(test, azimuth, drift_prior(study));
    if (!(seen->sigma_rate < best_known * detail::earth_rate)) return std::nullopt;
    site.latitude = seen->latitude;
    azimuth = seen->azimuth;
  }
  const double off = std::abs(seen->rate - detail::earth_rate);
  if (off > 3.0 * seen->sigma_rate + scale * detail::earth_rate) return std::nullopt;
  return seen;
}

}  // namespace

std::optional<LatitudeDoubt> latitude_doubt(const mc::Study& study, const Recording& recording,
                                            const CaseIdentification& id) {
  if (study.filters.front().active[d_lat]) return std::nullopt;
  const auto seen = earth_of(study, recording, id.study.search);
  if (!seen) return std::nullopt;
  mc::Study there = study;
  there.site.latitude = seen->latitude;
  const CaseStudy of = case_study(there, recording);
  if (!of.compass.sees_earth) return std::nullopt;
  FilterSpec filter = case_filter(there.filters.front(), of);
  filter.active.set(d_lat);
  filter.priors[d_lat] = normal(0.0, SiteLimits::bent_deg * unit::deg.to_si);
  const EstimateResult after = fit_batch(filter, of.measured(), start_of(filter, of)).estimate;
  const EstimateResult& before = id.fits.front().fit.estimate;
  const ParameterEstimate* rest = after.find(d_lat);
  // Far from where it was linearised the fit is of something else.
  if (rest == nullptr || std::abs(rest->value) > 2.0 * filter.priors[d_lat].sigma())
    return std::nullopt;
  LatitudeDoubt doubt;
  doubt.latitude = seen->latitude + rest->value;
  doubt.declared = study.site.latitude;
  doubt.sigma = rest->sigma;
  doubt.chi2_per_dof_before = before.statistic_per_dof();
  doubt.chi2_per_dof_after = after.statistic_per_dof();
  doubt.chance_after =
      doubt.chi2_per_dof_after > 1.0
          ? stats::chi_square_chance(doubt.chi2_per_dof_after, static_cast<double>(after.measured))
          : 1.0;
  const bool comparable = id.study.compass.sees_earth;
  const double off = (doubt.latitude - doubt.declared) / seen->sigma;
  doubt.log_evidence = identification::log_evidence_of_latitude(
      comparable ? (before.statistic - after.statistic) / std::max(1.0, doubt.chi2_per_dof_after)
                 : off * off,
      doubt.sigma);
  if (doubt.log_evidence + std::log(SiteLimits::another) <= 0.0) return std::nullopt;
  if (doubt.prior_sigmas() <= SiteLimits::survey) return std::nullopt;
  const double excess = doubt.chi2_per_dof_before - 1.0;
  const bool explains =
      doubt.chi2_per_dof_before - doubt.chi2_per_dof_after >= SiteLimits::most * excess;
  if (comparable && !(excess > 0.0 && explains)) return std::nullopt;
  doubt.mirrored =
      std::abs(doubt.latitude + doubt.declared) < 0.1 * std::abs(doubt.latitude - doubt.declared);
  return doubt;
}

}  // namespace drift::strapdown
