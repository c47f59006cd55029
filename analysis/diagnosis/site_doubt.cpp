#include "analysis/diagnosis/site_doubt.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/inference/thresholds.hpp"

namespace drift::diagnosis {
namespace {

using inference::SiteLimits;

constexpr auto d_lat = TermLibrary::index("d_lat");

/// Whether an amplitude of a cause is of no size that its prior knows (6e-7): another latitude,
/// which has none, may be what it takes up.
bool has_no_usual_size(const search::Cause& cause) {
  return std::ranges::any_of(cause.parameters, [](const search::CauseParameter& p) {
    return !p.profiled && std::abs(p.prior_sigmas) > inference::FitLimits::beyond_prior;
  });
}

bool worth_asking(const Diagnosis& d) {
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
  if (d.nominal.active[d_lat]) return std::nullopt;
  // Of such a cause, or of latitude_error, nothing would be left to ask with them in the model. The
  // latitude is believed where it leaves nothing.
  if (std::ranges::any_of(d.causes, has_no_usual_size))
    if (auto alone = identification::latitude_doubt(study, recordings, d.nominal);
        alone && alone->alone())
      return alone;
  if (!worth_asking(d)) return std::nullopt;
  return identification::latitude_doubt(study, recordings, d.has_patch ? d.patched : d.nominal);
}

}  // namespace drift::diagnosis
