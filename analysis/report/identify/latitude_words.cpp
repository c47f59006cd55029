#include "analysis/report/identify/latitude_words.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/report/page/wording.hpp"
#include "core/base/units.hpp"

namespace drift::report {

std::string latitude_text(const identification::LatitudeDoubt& doubt) {
  return fmt::format("{:.3f}±{:.2g} deg", doubt.latitude / unit::deg.to_si,
                     doubt.sigma / unit::deg.to_si);
}

std::string_view wrong_text(const identification::LatitudeDoubt& doubt) {
  return doubt.or_clock ? "latitude or times" : "latitude";
}

std::string or_clock_text(const identification::LatitudeDoubt& doubt) {
  if (!doubt.or_clock) return "";
  return fmt::format(
      "; or the times of the recording are not those of the platform: all {} times as long explain "
      "as much, and where nothing is commanded the two look alike",
      with_sigma(doubt.or_clock->factor, doubt.or_clock->sigma));
}

std::string upside_down_text(const identification::LatitudeDoubt& doubt) {
  if (!doubt.mirrored) return "";
  return " Three accelerometers that read down as up look the same: check their sign, too.";
}

std::string latitude_next(const identification::LatitudeDoubt& doubt, std::string_view command) {
  if (doubt.or_clock)
    return fmt::format(
        "Next: look up the latitude of the site on a map and the sample interval of the log, "
        "correct what is wrong (times by {:.7g}, or the latitude), and {} again.",
        doubt.or_clock->factor, command);
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
          {"alone", doubt->alone()},
          {"or_times_by", doubt->or_clock ? Json(doubt->or_clock->factor) : Json(nullptr)}};
}

}  // namespace drift::report
