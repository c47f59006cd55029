#include "analysis/cli/print.hpp"

#include <cerrno>
#include <cstdio>

#include "analysis/cli/verdict_colour.hpp"
#include "core/base/utf8.hpp"

namespace drift::cli {
namespace {

/// There is one terminal, and everything that prints asks for it.
Terminal& the_terminal() {
  static Terminal terminal;
  return terminal;
}

void write_results(const std::string& shown) {
  if (the_terminal().results == Terminal::Shown::no) return;
  if (std::fwrite(shown.data(), 1, shown.size(), stdout) != shown.size())
    throw OutputLost(errno, std::generic_category());
}

}  // namespace

void set_terminal(const Terminal& terminal) {
  the_terminal() = terminal;
}

void show_text(std::string_view text) {
  write_results(terminal_text(text));
}

void show_verdicts(std::string_view text) {
  const std::string shown = terminal_text(text);
  write_results(the_terminal().colour == Terminal::Shown::yes ? with_coloured_verdicts(shown)
                                                              : shown);
}

void say_text(std::string_view text) {
  if (the_terminal().remarks == Terminal::Shown::yes) complain_text(text);
}

void complain_text(std::string_view text) {
  constexpr std::size_t longest = 3000;  // [bytes] of a line
  // A line that is redrawn begins with a return, which is the program's own.
  const bool redrawn = text.starts_with('\r');
  const std::string shown =
      shortened_lines(terminal_text(redrawn ? text.substr(1) : text), longest);
  if (redrawn) std::fputc('\r', stderr);
  std::fwrite(shown.data(), 1, shown.size(), stderr);
  std::fflush(stderr);
}

void flush_output() {
  if (std::fflush(stdout) != 0) throw OutputLost(errno, std::generic_category());
}

}  // namespace drift::cli
