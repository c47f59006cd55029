#include <algorithm>

#include "analysis/identification/absent_channels.hpp"
#include "analysis/report/identify/clock_words.hpp"
#include "analysis/report/identify/delay_words.hpp"
#include "analysis/report/identify/judgement.hpp"
#include "analysis/report/identify/latitude_words.hpp"
#include "analysis/report/identify/loop_words.hpp"
#include "analysis/report/identify/turned_words.hpp"
#include "analysis/report/page/study_words.hpp"

namespace drift::report {
namespace {

/// What to add where a filter has a covariate from the recording, which a plan has not.
std::string covariates_to_rank_with(const mc::Study& study) {
  const CovariateSet missing = TermLibrary::needs(study.filters.front().model().terms).covariates &
                               ~study.environment.declared();
  std::string all;
  for (const CovariateSpec& c : known_covariates)
    if (!c.is_vector() && (missing & c.set()) != 0)
      all += fmt::format(
          " It needs the {} that is to be expected: --set environment.{}={} --set "
          "environment.{}_amplitude=\"{:g} {}\"",
          c.what, c.name, c.example, c.name, 0.2 * c.usual, c.unit.symbol.view());
  return all;
}

/// Instruments that no recording has, as a plan would be without them: " --set
/// readout.gimbals=false".
std::string absent_to_rank_with(const identification::Identification& id) {
  std::string all;
  for (const auto& [channels, key] : {std::pair{&accelerometer_channels, "accelerometers"},
                                      std::pair{&gimbal_channels, "gimbals"}})
    if (identification::lacks(id.absent, *channels))
      all += fmt::format(" --set readout.{}=false", key);
  return all;
}

}  // namespace

std::string next_step(const mc::Study& study, const identification::Identification& id,
                      const Judgement& j) {
  constexpr std::size_t most = 3;  // keys that are named
  const std::string recordings = id.simulated ? "RECORDING" : shell_words(id.sources);
  if (!late_labels_text(id.spikes).empty())
    return "Next: correct the numbers of the positions in the recording and identify again.";
  if (id.loop && std::ranges::all_of(study.filters, [&](const FilterSpec& filter) {
        return id.leaves_out_loop(filter);
      }))
    return loop_next(*id.loop, study.filters.front(), 0, "identify");
  if (id.delay) return delay_next(*id.delay, "identify");
  if (const auto* headings = other_headings(id)) return corrected_text(*headings, "identify");
  if (const auto doubt = other_latitude(id); doubt && (doubt->clock || doubt->alone()))
    return doubt->clock ? clock_next(*doubt->clock, "identify") : latitude_next(*doubt, "identify");
  if (!id.off_zero.empty()) return "Next: correct the zero, or its offset, and identify again.";
  if (j.good.empty() && !id.spikes.empty() && !other_latitude(id))
    return fmt::format(
        "Next: leave the isolated sample{} out (empty cells) and identify again; `driftscope "
        "diagnose` leaves {} out by itself.",
        id.spikes.size() == 1 ? "" : "s", id.spikes.size() == 1 ? "it" : "them");
  if (!j.first_fits || !j.first_favoured)
    return fmt::format(
        "Next: {}driftscope diagnose {} {} says what the first filter of the study lacks.",
        other_latitude(id) ? "correct the latitude by a map; then " : "", study_words(study),
        recordings);
  if (!j.first_far.empty())
    return fmt::format(
        "Next: driftscope diagnose {} {} says whether missing physics, or another drift equation, "
        "is behind {}.",
        study_words(study), recordings, listed_up_to(j.first_far, most));
  if (j.first_less_noise)
    return fmt::format(
        "Next: driftscope diagnose {} {} says how large the noise of each instrument is: declare "
        "that in [readout] and identify again.",
        study_words(study), recordings);
  if (j.unlearned && !id.absent_positions.empty())
    return fmt::format("Next: record {} of the plan as well, and identify again.",
                       positions_text(id.absent_positions));
  if (j.unlearned)
    return fmt::format(
        "Next: driftscope rank {}{} --improve 3 -o out/rank proposes positions that show what this "
        "test does not.{}",
        study_words(study), absent_to_rank_with(id), covariates_to_rank_with(study));
  return "";
}

}  // namespace drift::report
