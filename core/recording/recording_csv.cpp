#include "core/recording/recording_csv.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/seal.hpp"
#include "core/recording/own/csv_rows.hpp"

namespace drift {

bool add_fact(RawRecording& raw, std::string_view key, std::string_view value) {
  if (key.size() + value.size() > longest_fact) return false;
  const std::string clean = single_line(key), text = single_line(value);
  if (clean == seal_key) return true;  // of the file that was read, not of its content
  for (auto& [known, joined] : raw.facts)
    if (known == clean) {
      if (joined.size() + text.size() + 2 > longest_fact) return false;
      joined += "; " + text;
      return true;
    }
  if (raw.facts.size() >= most_facts) return false;
  raw.facts.emplace_back(clean, text);
  return true;
}

std::string single_line(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  return std::string(trimmed(out));
}

RawRecording read_csv(const std::string& path, const RecordingFormat& format, RecordingKind kind,
                      Problems& problems, const ReadProgress& progress) {
  CsvLayout layout = find_layout(path, format, kind);
  if (layout.header.empty()) {
    problems.add("1", "there is no header row", "a row such as 'time [s],acc_x [g],...'",
                 "Add the header, or check how the recording was exported");
    return {};
  }
  return CsvRows(path, std::move(layout), format, kind, problems).read(progress);
}

}  // namespace drift
