#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <string_view>

#include "analysis/report/page/escape.hpp"
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

/// Where the sentences of a text end, and with clauses the clauses before a semicolon, not within
/// brackets: the last sentence, which the end of the text ends, has no place.
std::vector<std::size_t> ends_within(std::string_view text, bool clauses) {
  std::vector<std::size_t> ends;
  int open = 0;
  for (std::size_t at = 0; at + 1 < text.size(); ++at) {
    open += text[at] == '(' ? 1 : text[at] == ')' ? -1 : 0;
    if (open > 0) continue;
    const bool abbreviates = at >= 2 && text.substr(at - 2, 4) == "eq. ";
    if ((text[at] == '.' || (clauses && text[at] == ';')) && text[at + 1] == ' ' && !abbreviates)
      ends.push_back(at);
  }
  return ends;
}

/// What is shown of a text, and how many sentences of it are not.
struct PartShown {
  std::vector<std::string> lines;
  std::size_t left_out = 0;
};

std::size_t sentences_in(std::string_view text) {
  return text.empty() ? 0 : ends_within(text, false).size() + 1;
}

/// A text in at most so many lines. What has no room is left off where a sentence or a clause
/// ends, so that nothing is shown without what qualifies it; failing that the last line ends with
/// "...", which says that there is more. kept: a sentence of the text that is shown in any case.
PartShown shortened(const std::string& text, std::size_t most, std::size_t width,
                    const std::string& kept = {}) {
  PartShown all{lines_of(text, width)};
  if (all.lines.size() <= most) return all;
  if (most == 0) return {{}, sentences_in(text)};
  const std::size_t place = kept.empty() ? std::string::npos : text.find(kept);
  std::vector<std::size_t> ends = ends_within(text, true);
  for (; !ends.empty(); ends.pop_back()) {
    const std::size_t end = ends.back();
    const bool behind = place != std::string::npos && place > end;
    auto fitting = lines_of(text.substr(0, end) + "." + (behind ? " " + kept : ""), width);
    if (fitting.size() <= most)
      return {std::move(fitting),
              sentences_in(std::string_view(text).substr(end + 2)) - (behind ? 1 : 0)};
  }
  const std::vector<std::string> last_lines =
      place == std::string::npos ? std::vector<std::string>{} : lines_of(kept, width);
  const std::size_t of_text = most - (last_lines.size() < most ? last_lines.size() : 0);
  all.lines.resize(of_text);
  std::string& last = all.lines.back();
  while (last.size() + cut_off.size() > width && last.find_last_of(' ') != std::string::npos)
    last.erase(last.find_last_of(' '));
  last += cut_off;
  if (of_text < most) all.lines.insert(all.lines.end(), last_lines.begin(), last_lines.end());
  return all;
}

/// The answer but for its last lines, which say what to do, in so many lines.
PartShown before_next(const InBrief& brief, std::size_t room, std::size_t width) {
  PartShown shown;
  const auto add = [&](const PartShown& part) {
    room -= part.lines.size();
    shown.lines.insert(shown.lines.end(), part.lines.begin(), part.lines.end());
    shown.left_out += part.left_out;
  };
  constexpr std::size_t least_of_verdict = 2;  // lines
  const std::vector<std::string> more = brief.more.texts();
  // What is wrong with the input is said whatever the verdict takes, and what was asked for.
  const std::size_t of_wrong = lines_of(brief.more.first_wrong(), width).size();
  std::size_t of_asked = 0;
  for (std::size_t k = 0; k < std::min(brief.asked, more.size()); ++k)
    of_asked += lines_of(more[k], width).size();
  const std::size_t of_kept =
      brief.kept.empty() ? 0 : lines_of(brief.kept, width).size() + least_of_verdict;
  const std::size_t kept =
      std::min(std::max(std::min(of_wrong, room / 2),
                        std::min(of_asked, room - std::min(room, least_of_verdict))),
               room - std::min(room, of_kept));
  room -= kept;
  add(shortened(brief.verdict, room, width, brief.kept));
  room += kept;
  for (const std::string& text : more) {
    const PartShown part = shortened(text, room, width);
    if (part.lines.empty() || part.lines.back().ends_with(cut_off))
      shown.left_out += sentences_in(text);  // with nothing whole to be said: not at all
    else
      add(part);
  }
  return shown;
}

}  // namespace

std::string brief_text(const InBrief& brief, std::size_t width) {
  constexpr std::size_t most_of_next = 4;
  const PartShown next = shortened(brief.next, most_of_next, width);
  const std::size_t room = most_brief_lines - next.lines.size();
  const auto note_of = [&](const PartShown& shown) {
    const std::size_t count = shown.left_out + next.left_out;
    return count == 0 ? std::string()
                      : fmt::format("({} more sentence{}: --full)", count, count == 1 ? "" : "s");
  };
  // How many sentences are left out ends the last line where it has room, else it has a line.
  const auto has_room = [&](const PartShown& shown) {
    return !shown.lines.empty() &&
           display_width(shown.lines.back()) + 1 + note_of(shown).size() <= width;
  };
  PartShown shown = before_next(brief, room, width);
  if (!note_of(shown).empty() && !has_room(shown)) shown = before_next(brief, room - 1, width);
  if (const std::string note = note_of(shown); has_room(shown) && !note.empty())
    shown.lines.back() += " " + note;
  else if (!note.empty())
    shown.lines.push_back(note);
  shown.lines.insert(shown.lines.end(), next.lines.begin(), next.lines.end());
  std::string out;
  for (const std::string& line : shown.lines) out += line + '\n';
  return out;
}

std::string whole_text(const InBrief& brief, std::size_t width) {
  std::string out;
  const auto add = [&](const std::string& text) {
    for (const std::string& line : lines_of(text, width)) out += line + '\n';
  };
  add(brief.verdict);
  for (const std::string& text : brief.more.texts()) add(text);
  add(brief.next);
  return out;
}

}  // namespace drift::report
