#include "analysis/report/diagnosis/doubts.hpp"

#include "analysis/report/page/wording.hpp"
#include "core/base/units.hpp"

namespace drift::report {

std::string site_text(const identification::LatitudeDoubt& doubt) {
  if (!doubt.alone())
    return fmt::format(
        "The latitude of [site] is not that of the recording, and alone it mends nothing: at about "
        "{:.1f} deg instead of {:.3f} deg the model fits with chi-square per degree of freedom "
        "{:.3g} instead of {:.3g}, where 1 is expected (by chance: {}). Something else is missing "
        "too, or the noise is not as declared, and it moves the latitude that fits.",
        doubt.latitude / unit::deg.to_si, doubt.declared / unit::deg.to_si,
        doubt.chi2_per_dof_after, doubt.chi2_per_dof_before, p_text(doubt.chance_after));
  return fmt::format(
      "The latitude of [site] is not that of the recording: at {:.3f} deg instead of {:.3f} deg "
      "the model fits with chi-square per degree of freedom {:.3g} instead of {:.3g}. No "
      "survey is wrong by so much (latitude_error would need {:.3g} prior sigmas): correct the "
      "latitude and diagnose again before anything else is made of it.",
      doubt.latitude / unit::deg.to_si, doubt.declared / unit::deg.to_si, doubt.chi2_per_dof_after,
      doubt.chi2_per_dof_before, doubt.prior_sigmas);
}

}  // namespace drift::report
