#include "analysis/report/identify/input_doubts.hpp"

#include <nlohmann/json.hpp>

#include "analysis/report/identify/delay_words.hpp"
#include "analysis/report/identify/loop_words.hpp"
#include "analysis/report/page/wording.hpp"

namespace drift::report {
namespace {

/// Beside a filter that knows of the loop the others are there to be compared.
void add_loop(const mc::Study& study, const identification::Identification& id,
              std::vector<InputDoubt>& doubts) {
  std::vector<std::string> without;
  for (const FilterSpec& filter : study.filters)
    if (id.leaves_out_loop(filter)) without.push_back(filter.name);
  if (without.empty()) return;
  doubts.push_back({without.size() == study.filters.size() ? Weight::wrong : Weight::note, "Loop",
                    loop_left_out_text(*id.loop, id.names, without)});
}

}  // namespace

std::vector<InputDoubt> input_doubts(const mc::Study& study,
                                     const identification::Identification& id, bool fits) {
  std::vector<InputDoubt> doubts;
  if (!id.off_zero.empty()) doubts.push_back({Weight::wrong, "Gimbals", id.off_zero + "."});
  if (id.delay) doubts.push_back({Weight::wrong, "Instants", delay_text(*id.delay)});
  add_loop(study, id, doubts);
  const std::size_t count = id.spikes.size();
  if (std::string labels = late_labels_text(id.spikes, id.names); !labels.empty())
    doubts.push_back({Weight::wrong, "Labels", std::move(labels)});
  else if (count > 0)
    doubts.push_back(
        {fits ? Weight::doubtful : Weight::wrong, "Outliers",
         fmt::format("{} isolated sample{} far from those around{}, and in the fit: leave {} out "
                     "(an empty cell).",
                     count, count == 1 ? " is" : "s are", spikes_text(id.spikes, id.names),
                     count == 1 ? "it" : "them")});
  return doubts;
}

void add_input(Json& document, const std::string& gimbal_zero,
               const std::vector<identification::Spike>& spikes) {
  document["gimbal_zero"] = text_or_null(gimbal_zero);
  Json& outliers = document["outliers"] = Json::array();
  for (const identification::Spike& s : spikes)
    outliers.push_back({{"channel", spike_channel(s)},
                        {"position", s.position},
                        {"time_s", s.t},  // by the clock of its recording
                        {"recording", s.recording}});
  document["late_labels"] = identification::late_labels(spikes);
}

}  // namespace drift::report
