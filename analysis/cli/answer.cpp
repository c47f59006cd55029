#include "analysis/cli/answer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "analysis/cli/print.hpp"

namespace drift::cli {
namespace {

/// Where the report is, what lies beside it, and how to see the rest.
std::string where_text(const Rest& rest, std::size_t width) {
  std::string out;
  std::vector<std::string> others = rest.files;
  if (std::erase(others, "report.html") > 0)
    out += fmt::format("Report: {}/report.html\n", rest.folder);
  if (!others.empty())
    out += report::wrapped(fmt::format("{}{}: {}", out.empty() ? "Written to " : "Beside it",
                                       out.empty() ? rest.folder : "", fmt::join(others, " ")),
                           width, 2);
  if (terminal().details == Terminal::Shown::no && !rest.details.empty())
    out += "Details: the same command with --full prints them.\n";
  return out;
}

}  // namespace

void show_answer(const report::InBrief& brief, const Rest& rest) {
  const std::size_t width = terminal_width(report::least_brief_width);
  if (terminal().json == Terminal::Shown::yes) {
    show_text(rest.document);
    if (!rest.files.empty()) say("\nWritten to {}: {}\n", rest.folder, fmt::join(rest.files, " "));
    return;
  }
  const bool whole = terminal().details == Terminal::Shown::yes;
  show_judgement(whole ? report::whole_text(brief, width) : report::brief_text(brief, width),
                 brief.tone);
  if (const std::string where = where_text(rest, width); !where.empty()) show("\n{}", where);
  if (!whole) return;
  show("\n");
  show_verdicts(rest.details);
}

void show_beside_answer(const std::string& text) {
  if (terminal().json == Terminal::Shown::yes)
    say_text(text);
  else
    show_text(text);
}

}  // namespace drift::cli
