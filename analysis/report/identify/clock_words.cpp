#include "analysis/report/identify/clock_words.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/inference/thresholds.hpp"
#include "analysis/report/page/wording.hpp"
#include "core/base/units.hpp"

namespace drift::report {

std::string clock_text(const identification::LatitudeDoubt& doubt) {
  const identification::ClockDoubt& clock = *doubt.clock;
  return fmt::format(
      "The times of the recording are not those of the platform: with all of them {} times as long "
      "the model fits with chi-square per degree of freedom {} instead of {}. (At {:.3f} deg in "
      "place of the latitude of [site] it would fit, too, with three torquers off by the same.)",
      with_sigma(clock.factor, clock.sigma), number_text(clock.chi2_per_dof_after),
      number_text(clock.chi2_per_dof_before), doubt.latitude / unit::deg.to_si);
}

std::string clock_next(const identification::ClockDoubt& clock, std::string_view command) {
  return fmt::format(
      "Next: find out what the clock of the log was (a sample interval that is not what was "
      "written down?), multiply the times by {:.7g} and {} again.",
      clock.factor, command);
}

std::string times_instead_text(const identification::ClockDoubt& clock) {
  return fmt::format(
      "Times that are all too {} would leave the same: with every time {} times as long the "
      "nominal model fits by itself (chi-square per degree of freedom {} instead of {}). Check the "
      "clock and the sample interval of the log.",
      clock.factor > 1.0 ? "short" : "long", with_sigma(clock.factor, clock.sigma),
      number_text(clock.chi2_per_dof_after), number_text(clock.chi2_per_dof_before));
}

std::string times_in_brief(const identification::ClockDoubt& clock) {
  return fmt::format(
      "Times that are all too {} would leave the same (every time {} times as long): check the "
      "clock of the log.",
      clock.factor > 1.0 ? "short" : "long", with_sigma(clock.factor, clock.sigma));
}

std::string times_off_text(const identification::ClockDoubt& clock) {
  return fmt::format("{:.2g} % too {}", 100.0 * std::abs(1.0 / clock.factor - 1.0),
                     clock.factor > 1.0 ? "short" : "long");
}

std::string times_as_little_text(const identification::ClockDoubt& clock, double odds) {
  return fmt::format(
      "times (the clock of the log) that are all {} would leave as little{} (every time {} times "
      "as long)",
      times_off_text(clock), odds > inference::RemarkLimits::decided ? " and are far likelier" : "",
      with_sigma(clock.factor, clock.sigma));
}

Json times_json(const std::optional<identification::ClockDoubt>& clock) {
  if (!clock) return nullptr;
  return {{"factor", clock->factor},
          {"sigma", clock->sigma},
          {"chi2_per_dof_before", clock->chi2_per_dof_before},
          {"chi2_per_dof_after", clock->chi2_per_dof_after}};
}

Json clock_json(const std::optional<identification::LatitudeDoubt>& doubt) {
  if (!doubt || !doubt->clock) return nullptr;
  Json json = times_json(doubt->clock);
  json["or_latitude_deg"] = doubt->latitude / unit::deg.to_si;
  return json;
}

}  // namespace drift::report
