#include "analysis/report/identify/loop_words.hpp"

#include <fmt/format.h>

#include "analysis/report/page/study_words.hpp"
#include "core/base/words.hpp"
#include "core/physics/coupling.hpp"

namespace drift::report {

std::string loop_left_out_text(const identification::StatedLoop& loop,
                               const std::vector<std::string>& recordings,
                               const std::vector<std::string>& filters) {
  std::vector<std::string> who;
  for (const std::size_t number : loop.recordings)
    if (number <= recordings.size()) who.push_back(recordings[number - 1]);
  if (who.empty()) who.emplace_back("the recording");
  std::string text = fmt::format(
      "{} state{} that a loop removed misalignments of the gyros (loop_eta_x to loop_xi_z), and "
      "filter{} {} leave{} that out: misalignments and drift equation come out as no unit has "
      "them. Coupling \"{}\" knows of it.",
      listed(who, "and"), who.size() > 1 ? "" : "s", filters.size() > 1 ? "s" : "",
      listed(filters, "and"), filters.size() > 1 ? "" : "s", key_of(Coupling::compensated));
  if (recordings.empty()) text.front() = 'T';
  return text;
}

std::string loop_next(const identification::StatedLoop& loop, const FilterSpec& filter,
                      std::size_t number, std::string_view command) {
  return fmt::format(
      "Next: {}{} again with the loop in the filter: --set {}.",
      loop.whole ? ""
                 : "give every recording the columns loop_eta_x to loop_xi_z, 0 where no loop "
                   "removed anything, and ",
      command,
      shell_word(fmt::format("{}={}", key_of_filter(filter, number, "coupling"),
                             key_of(Coupling::compensated))));
}

}  // namespace drift::report
