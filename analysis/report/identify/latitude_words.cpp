#include "analysis/report/identify/latitude_words.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/base/units.hpp"

namespace drift::report {

std::string latitude_text(const identification::LatitudeDoubt& doubt) {
  return fmt::format("{:.3f}±{:.2g} deg", doubt.latitude / unit::deg.to_si,
                     doubt.sigma / unit::deg.to_si);
}

std::string latitude_next(const identification::LatitudeDoubt& doubt, std::string_view command) {
  if (doubt.alone() && doubt.as_surveyed())
    return fmt::format("Next: {} again with --set site.latitude=\"{:.3f} deg\".", command,
                       doubt.latitude / unit::deg.to_si);
  return fmt::format("Next: {} again with the latitude of the site as a map has it{}.", command,
                     doubt.alone() ? "" : ": what is missing beside it shows then");
}

Json latitude_json(const std::optional<identification::LatitudeDoubt>& doubt) {
  if (!doubt || doubt->clock) return nullptr;
  return {{"declared_deg", doubt->declared / unit::deg.to_si},
          {"of_recording_deg", doubt->latitude / unit::deg.to_si},
          {"sigma_deg", doubt->sigma / unit::deg.to_si},
          {"prior_sigmas", doubt->prior_sigmas()},
          {"chi2_per_dof_before", doubt->chi2_per_dof_before},
          {"chi2_per_dof_after", doubt->chi2_per_dof_after},
          {"chance_after", doubt->chance_after},
          {"odds", doubt->odds},
          {"alone", doubt->alone()}};
}

}  // namespace drift::report
