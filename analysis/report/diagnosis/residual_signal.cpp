#include "analysis/report/diagnosis/residual_signal.hpp"

#include <fmt/format.h>

#include <cmath>

#include "analysis/report/diagnosis/words.hpp"

namespace drift::report {
namespace {

std::string cell(double value) {
  return std::isfinite(value) ? fmt::format("{:.9g}", value) : "";
}

/// A text without what would break a line of CSV.
std::string plain(std::string text) {
  for (char& c : text)
    if (c == ',' || c == '"' || static_cast<unsigned char>(c) < 0x20) c = ' ';
  return text;
}

}  // namespace

std::string residual_signal_csv(const std::vector<diagnosis::RecoveredSignal>& signals,
                                const std::vector<diagnosis::RecordingSpan>& recordings) {
  std::string out =
      "# what the nominal model does not explain, as the input that would explain it; sigma: 1 "
      "standard deviation\n";
  for (const auto& s : signals)
    if (!s.shape.empty()) out += fmt::format("# {} = {}\n", plain(s.equation), plain(s.shape));
  for (const auto& r : recordings)
    out += fmt::format("# {} = its own time is time [s] less {:.9g}\n", plain(r.name), r.offset_s);
  out += fmt::format("equation,time [s],position,value,sigma,explained,unit{}\n",
                     recordings.empty() ? "" : ",recording");
  for (const auto& s : signals)
    for (std::size_t i = 0; i < s.value.size(); ++i) {
      const auto* recording = recording_at(recordings, s.t[i]);
      out += fmt::format("{},{},{},{},{},{},{}{}\n", plain(s.equation), cell(s.t[i]),
                         i < s.position.size() ? s.position[i] : 0, cell(s.value[i]),
                         i < s.sigma.size() ? cell(s.sigma[i]) : "",
                         i < s.explained.size() ? cell(s.explained[i]) : "", plain(s.unit),
                         recording ? "," + plain(recording->name) : "");
    }
  return out;
}

}  // namespace drift::report
