#include "analysis/cli/verdict_colour.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include "analysis/report/diagnosis/words/verdict_openings.hpp"

namespace drift::cli {
namespace {

constexpr std::string_view green = "\x1b[32m", red = "\x1b[1;31m", yellow = "\x1b[33m",
                           plain = "\x1b[0m";

constexpr std::pair<std::string_view, std::string_view> verdicts[] = {
    {"ok", green},
    {"misfit", red},
    {"Consistent:", green},
    {"Named:", yellow},
    {"Ambiguous:", red},
    {"Unexplained:", red},
    {report::agrees, green},
    {report::something_missing, red},
    {report::something_may_be_missing, yellow}};

bool part_of_word(std::string_view text, std::size_t at) {
  if (at >= text.size()) return false;
  const auto c = static_cast<unsigned char>(text[at]);
  return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.' || c == '/' || c >= 0x80;
}

/// Within a text of several words `ok` may be prose; as a cell of a table it stands between blanks.
bool stands_alone(std::string_view text, std::size_t at, std::size_t size) {
  return (at == 0 || !part_of_word(text, at - 1)) &&
         (text[at + size - 1] == ':' || !part_of_word(text, at + size));
}

}  // namespace

std::string with_coloured_verdicts(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const auto found = std::ranges::find_if(verdicts, [&](const auto& v) {
      return text.substr(at).starts_with(v.first) && stands_alone(text, at, v.first.size());
    });
    if (found == std::end(verdicts)) {
      out += text[at++];
      continue;
    }
    out.append(found->second).append(found->first).append(plain);
    at += found->first.size();
  }
  return out;
}

std::string with_coloured_judgement(std::string_view text, report::Tone tone) {
  const auto colon = text.find(':');
  const std::string_view colour = tone == report::Tone::good       ? green
                                  : tone == report::Tone::doubtful ? yellow
                                  : tone == report::Tone::bad      ? red
                                                                   : "";
  if (colour.empty() || colon == std::string_view::npos) return with_coloured_verdicts(text);
  return std::string(colour).append(text.substr(0, colon + 1)).append(plain) +
         with_coloured_verdicts(text.substr(colon + 1));
}

}  // namespace drift::cli
