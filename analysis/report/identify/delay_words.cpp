#include "analysis/report/identify/delay_words.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/report/page/wording.hpp"

namespace drift::report {
namespace {

using identification::DelayDoubt;

std::string_view name_of(DelayDoubt::Of of) {
  return of == DelayDoubt::Of::accelerometers ? "accelerometers" : "gimbals";
}

/// "the gimbals as 0.985±0.064 s older than their rows say".
std::string taken_as(const DelayDoubt& delay) {
  std::string text = fmt::format("the {} as {} s {} than their rows say", name_of(delay.of),
                                 with_sigma(std::abs(delay.late), delay.sigma),
                                 delay.late > 0.0 ? "older" : "later");
  if (delay.either && !delay.momentary())
    text += fmt::format(" (or the {} as much {})",
                        name_of(delay.of == DelayDoubt::Of::gimbals ? DelayDoubt::Of::accelerometers
                                                                    : DelayDoubt::Of::gimbals),
                        delay.late > 0.0 ? "later" : "older");
  return text;
}

}  // namespace

std::string delay_text(const DelayDoubt& delay) {
  return fmt::format(
      "Accelerometers and gimbals are of different instants{}: with {} the model fits with "
      "chi-square per degree of freedom {} instead of {}.{}",
      delay.alone() ? "" : ", and that is not all", taken_as(delay),
      number_text(delay.chi2_per_dof_after), number_text(delay.chi2_per_dof_before),
      delay.momentary()
          ? fmt::format(" Rows are {} s apart, and acc_* are means over that: these may be "
                        "momentary readings, half an interval later.",
                        number_text(delay.interval))
          : "");
}

std::string delay_next(const DelayDoubt& delay, std::string_view command) {
  if (delay.momentary())
    return fmt::format(
        "Next: find out what the accelerometers of a row are. If they are momentary readings, say "
        "so (--set recording.accelerometers=momentary, or --set "
        "recording.accelerometers_late=\"{:.3g} s\" where they are short means) and {} again.",
        delay.late, command);
  return fmt::format(
      "Next: find out which of the two is late in the log, bring both to one time, or say by how "
      "much (--set recording.{}_late=\"{:.3g} s\"), and {} again.",
      name_of(delay.of), delay.late, command);
}

Json delay_json(const std::optional<DelayDoubt>& delay) {
  if (!delay) return nullptr;
  return {{"of", name_of(delay->of)},
          {"either", delay->either},
          {"late_s", delay->late},
          {"sigma_s", delay->sigma},
          {"interval_s", delay->interval},
          {"momentary", delay->momentary()},
          {"chi2_per_dof_before", delay->chi2_per_dof_before},
          {"chi2_per_dof_after", delay->chi2_per_dof_after}};
}

}  // namespace drift::report
