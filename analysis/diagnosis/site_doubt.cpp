#include "analysis/diagnosis/site_doubt.hpp"

#include <algorithm>

#include "analysis/inference/thresholds.hpp"

namespace drift::diagnosis {
namespace {

using inference::SiteLimits;

constexpr auto d_lat = TermLibrary::index("d_lat");

bool worth_asking(const Diagnosis& d) {
  if (d.nominal.active[d_lat]) return false;
  if (d.verdict == Verdict::unexplained) return true;
  // Parameters far outside their priors may hide it: Earth rate about Up is isotropic D_I.
  if (std::ranges::any_of(d.remarks, [](const Remark& r) {
        const auto* beyond = std::get_if<remark::BeyondPrior>(&r);
        return beyond && beyond->farthest().sigmas > inference::FitLimits::beyond_prior;
      }))
    return true;
  if (d.verdict == Verdict::consistent) return d.fit.chi2_per_dof_before > d.fit.band_high;
  double top = 0.0, own = 0.0, size = 0.0;
  for (const search::CandidateScore& c : d.candidates) {
    top = std::max(top, c.score);
    if (c.term != "latitude_error") continue;
    own = c.score;
    size = c.size_sigma;
  }
  return own > SiteLimits::worth_asking * top && size > SiteLimits::survey;
}

}  // namespace

std::optional<identification::LatitudeDoubt> site_doubt(const mc::Study& study,
                                                        const std::vector<Recording>& recordings,
                                                        const Diagnosis& d) {
  if (!worth_asking(d)) return std::nullopt;
  return identification::latitude_doubt(study, recordings, d.has_patch ? d.patched : d.nominal);
}

}  // namespace drift::diagnosis
