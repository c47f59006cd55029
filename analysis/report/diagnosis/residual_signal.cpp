#include "analysis/report/diagnosis/sections.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "core/base/utf8.hpp"

namespace drift::report {

std::string residual_signal_csv(const std::vector<diagnosis::RecoveredSignal>& signals,
                                const std::vector<diagnosis::RecordingSpan>& recordings) {
  std::string facts =
      "# what the nominal model does not explain, as the input that would explain it; sigma: 1 "
      "standard deviation\n";
  for (const auto& s : signals)
    if (const std::string shape = shape_text(s, recordings); !shape.empty())
      facts += fmt::format("# {} = {}\n", text_of_name(s.equation), text_of_name(shape));
  for (const auto& r : recordings)
    facts += fmt::format("# {} = its own time is time [s] less {:.9g}\n", text_of_name(r.name),
                         r.offset_s);
  Table table("", "equation= | time [s]= | position= | value= | sigma= | explained= | unit=");
  if (!recordings.empty()) table.add_columns("recording=");
  const auto at = [](const std::vector<double>& values, std::size_t i) {
    return only_value(i < values.size() ? Value(values[i]) : Value());
  };
  for (const auto& s : signals)
    for (std::size_t i = 0; i < s.value.size(); ++i) {
      table.add({s.equation, s.t[i], i < s.position.size() ? s.position[i] : 0, s.value[i],
                 at(s.sigma, i), at(s.explained, i), s.unit});
      if (const auto* recording = recording_at(recordings, s.t[i]))
        table.rows.back().cells.emplace_back(recording->name);
    }
  return facts + csv_of(table);
}

}  // namespace drift::report
