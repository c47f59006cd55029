#include <sstream>

#include "analysis/report/page/report.hpp"

namespace drift::report {
namespace {

std::vector<std::string> lines_of(const std::string& sentence, std::size_t width) {
  std::vector<std::string> lines;
  if (sentence.empty()) return lines;
  std::istringstream text(wrapped(sentence, width, 2));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// At most so many lines; the last of a sentence that is longer ends with "...".
void shorten(std::vector<std::string>& lines, std::size_t most, std::size_t width) {
  constexpr std::string_view mark = " ...";
  if (lines.size() <= most) return;
  lines.resize(most);
  if (lines.empty()) return;
  std::string& last = lines.back();
  while (last.size() + mark.size() > width && last.find_last_of(' ') != std::string::npos)
    last.erase(last.find_last_of(' '));
  last += mark;
}

}  // namespace

std::string brief_text(const InBrief& brief, std::size_t width) {
  constexpr std::size_t most_of_next = 4;
  std::vector<std::string> next = lines_of(brief.next, width);
  shorten(next, most_of_next, width);
  std::size_t room = most_brief_lines - next.size();
  std::vector<std::string> shown;
  const auto add = [&](const std::string& sentence) {
    std::vector<std::string> lines = lines_of(sentence, width);
    shorten(lines, room, width);
    room -= lines.size();
    shown.insert(shown.end(), lines.begin(), lines.end());
  };
  add(brief.verdict);
  for (const std::string& sentence : brief.more) add(sentence);
  shown.insert(shown.end(), next.begin(), next.end());
  std::string out;
  for (const std::string& line : shown) out += line + '\n';
  return out;
}

}  // namespace drift::report
