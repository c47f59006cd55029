#include <algorithm>
#include <sstream>

#include "analysis/report/page/report.hpp"

namespace drift::report {
namespace {

constexpr std::string_view cut_off = " ...";

std::vector<std::string> lines_of(const std::string& sentence, std::size_t width) {
  std::vector<std::string> lines;
  if (sentence.empty()) return lines;
  std::istringstream text(wrapped(sentence, width, 2));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// The longest beginning of a text that is whole: up to the end of a sentence or of a clause before
/// a semicolon, not within brackets. Empty where there is none.
std::string whole_part(const std::string& text, std::size_t most) {
  std::size_t end = 0;
  int open = 0;
  for (std::size_t at = 0; at + 1 < text.size() && at < most; ++at) {
    open += text[at] == '(' ? 1 : text[at] == ')' ? -1 : 0;
    if (open > 0) continue;
    const bool abbreviates = at >= 2 && text.compare(at - 2, 4, "eq. ") == 0;
    if ((text[at] == '.' || text[at] == ';') && text[at + 1] == ' ' && !abbreviates) end = at;
  }
  return end == 0 ? "" : text.substr(0, end) + ".";
}

/// A sentence in at most so many lines. What has no room is left off where a sentence or a clause
/// ends, so that nothing is shown without what qualifies it; failing that the last line ends with
/// "...".
std::vector<std::string> shortened(const std::string& sentence, std::size_t most,
                                   std::size_t width) {
  std::vector<std::string> lines = lines_of(sentence, width);
  if (lines.size() <= most || most == 0) return most == 0 ? std::vector<std::string>{} : lines;
  for (std::string part = whole_part(sentence, most * width); !part.empty();
       part = whole_part(part, part.size() - 2))
    if (auto fitting = lines_of(part, width); fitting.size() <= most) return fitting;
  lines.resize(most);
  std::string& last = lines.back();
  while (last.size() + cut_off.size() > width && last.find_last_of(' ') != std::string::npos)
    last.erase(last.find_last_of(' '));
  last += cut_off;
  return lines;
}

}  // namespace

std::string brief_text(const InBrief& brief, std::size_t width) {
  constexpr std::size_t most_of_next = 4;
  const std::vector<std::string> next = shortened(brief.next, most_of_next, width);
  std::size_t room = most_brief_lines - next.size();
  std::vector<std::string> shown;
  const auto add = [&](const std::string& sentence) {
    const std::vector<std::string> lines = shortened(sentence, room, width);
    room -= lines.size();
    shown.insert(shown.end(), lines.begin(), lines.end());
  };
  // What is wrong with the input is said whatever the verdict takes.
  const std::size_t of_wrong = lines_of(brief.more.first_wrong(), width).size();
  const std::size_t kept = std::min(of_wrong, room / 2);
  room -= kept;
  add(brief.verdict);
  room += kept;
  for (const std::string& sentence :
       brief.more.texts())  // with nothing whole to be said: not at all
    if (const auto lines = shortened(sentence, room, width);
        !lines.empty() && !lines.back().ends_with(cut_off))
      add(sentence);
  shown.insert(shown.end(), next.begin(), next.end());
  std::string out;
  for (const std::string& line : shown) out += line + '\n';
  return out;
}

}  // namespace drift::report
