#include "analysis/preparation/own_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace drift::preparation {

std::string in_own_names(std::string message, const RecordingFormat& format) {
  std::vector<std::string> named;
  const auto replace = [&](const std::string& from, const std::string& to) {
    bool found = false;
    for (std::size_t at = 0; (at = message.find(from, at)) != std::string::npos; at += to.size()) {
      message.replace(at, from.size(), to);
      found = true;
    }
    return found;
  };
  for (const MappedColumn& m : format.columns) {
    const bool a_word = m.channel.find('_') == std::string::npos;  // "position", "time"
    if (m.own == m.channel || message.find(m.channel) == std::string::npos) continue;
    if (a_word) {
      replace(fmt::format("\"{}\"", m.channel), fmt::format("\"{}\"", m.own));
      continue;
    }
    const std::string unit = m.unit ? fmt::format(" [{}]", *m.unit) : "";
    for (const double sign : {1.0, -1.0})
      if (replace(fmt::format("\"{}{}\"", sign < 0.0 ? "-" : "", m.channel),
                  fmt::format("\"{}{}{}\"", sign * m.sign < 0.0 ? "-" : "", m.own, unit)) &&
          m.unit)
        replace(", with its unit as in the header", "");
    if (m.unit) replace(", each with its unit as in the header", "");
    named.push_back(fmt::format("{} is {}'{}'", m.channel, m.sign < 0.0 ? "minus " : "", m.own));
  }
  return named.empty() ? message : fmt::format("{} ({})", message, fmt::join(named, ", "));
}

void correct_alone(std::vector<std::string>& messages, const mc::Study& study,
                   const std::vector<std::string>& files) {
  if (files.size() < 2) return;
  // What was converted has the program's own columns, which the section would read once more.
  const bool has_section = std::ranges::any_of(study.resolved, [](const mc::Resolved& r) {
    return r.key.starts_with("recording.") && !r.origin.starts_with("default");
  });
  for (const std::string& file : files) {
    const auto first = std::ranges::find_if(messages, [&](const std::string& m) {
      return m.starts_with(file + ":") && m.find("[recording]") != std::string::npos;
    });
    if (file.empty() || first == messages.end()) continue;
    const bool ended = first->ends_with('.') || first->ends_with('?');
    *first += fmt::format(
        "{} [recording] is one for all recordings that are given: where that is wrong for others, "
        "correct this one by itself, with the line in a copy of the study (driftscope convert "
        "COPY.toml {} -o corrected.csv), {}",
        ended ? "" : ".", file,
        has_section ? "convert the others with the study as it is, and give all of them with a "
                      "study without [recording]"
                    : "and give what that writes in its place");
  }
}

}  // namespace drift::preparation
