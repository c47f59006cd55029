#include "analysis/cli/print.hpp"

#include <cerrno>
#include <cstdio>

#include "core/base/utf8.hpp"

namespace drift::cli {

void show_text(std::string_view text) {
  const std::string shown = terminal_text(text);
  if (std::fwrite(shown.data(), 1, shown.size(), stdout) != shown.size())
    throw OutputLost(errno, std::generic_category());
}

void say_text(std::string_view text) {
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
