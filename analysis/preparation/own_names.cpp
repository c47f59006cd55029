#include "analysis/preparation/own_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

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
    if (a_word || m.own == m.channel || message.find(m.channel) == std::string::npos) continue;
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

}  // namespace drift::preparation
