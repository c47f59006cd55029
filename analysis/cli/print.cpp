#include "analysis/cli/print.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "analysis/cli/verdict_colour.hpp"
#include "core/base/utf8.hpp"

namespace drift::cli {
namespace {

/// There is one terminal, and everything that prints asks for it.
Terminal& the_terminal() {
  static Terminal terminal;
  return terminal;
}

/// Arguments that hold line ends or other control characters: names of files, mostly.
std::vector<std::string>& steering_arguments() {
  static std::vector<std::string> names;
  return names;
}

/// A text in which those names stand as on one line.
std::string with_plain_names(std::string_view text) {
  std::string out(text);
  for (const std::string& name : steering_arguments()) {
    const std::string plain = text_of_name(name);
    for (std::size_t at = 0; (at = out.find(name, at)) != std::string::npos; at += plain.size())
      out.replace(at, name.size(), plain);
  }
  return out;
}

/// What is printed of a text.
std::string printed(std::string_view text) {
  return terminal_text(steering_arguments().empty() ? std::string(text) : with_plain_names(text));
}

volatile std::sig_atomic_t open_line = 0;  // a signal handler reaches nothing but globals

void end_open_line() {
  if (open_line != 0) std::fputc('\n', stderr);
  open_line = 0;
}

void write_results(const std::string& shown) {
  if (the_terminal().results == Terminal::Shown::no) return;
  end_open_line();
  if (std::fwrite(shown.data(), 1, shown.size(), stdout) != shown.size())
    throw OutputLost(errno, std::generic_category());
}

void write_line(const std::string& line) {
  std::fwrite(line.data(), 1, line.size(), stderr);
  std::fflush(stderr);
}

/// A remark as one JSON object on one line.
/// The level stands by itself, and need not begin the message as in words.
std::string json_line(std::string_view text, std::string_view level) {
  while (text.starts_with('\n')) text.remove_prefix(1);
  while (text.ends_with('\n')) text.remove_suffix(1);
  if (text.starts_with(level) && text.substr(level.size()).starts_with(": "))
    text.remove_prefix(level.size() + 2);
  const nlohmann::ordered_json object{{"level", level}, {"message", text}};
  return object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void write_remark(std::string_view text, std::string_view level) {
  constexpr std::size_t longest = 3000;  // [bytes] of a line
  // A line that is redrawn begins with a return, which is the program's own.
  const bool redrawn = text.starts_with('\r');
  const std::string shown = shortened_lines(printed(redrawn ? text.substr(1) : text), longest);
  if (the_terminal().lines == Terminal::Lines::json) {
    if (!shown.empty()) write_line(json_line(shown, level));
    return;
  }
  if (redrawn)
    std::fputc('\r', stderr);
  else
    end_open_line();
  open_line = redrawn && !shown.ends_with('\n') ? 1 : 0;
  write_line(shown);
}

}  // namespace

void set_terminal(const Terminal& terminal) {
  the_terminal() = terminal;
}

void files_take_results() {
  if (the_terminal().remarks == Terminal::Shown::no) the_terminal().results = Terminal::Shown::no;
}

void set_arguments(std::span<char* const> arguments) {
  for (const std::string_view argument : arguments)
    // One of nothing but a line end would take all lines apart.
    if (text_of_name(argument) != argument &&
        argument.find_first_not_of("\n\t ") != argument.npos) {
      const std::size_t value = argument.starts_with("--") ? argument.find('=') : argument.npos;
      steering_arguments().emplace_back(value == argument.npos ? argument
                                                               : argument.substr(value + 1));
    }
}

const Terminal& terminal() {
  return the_terminal();
}

std::size_t terminal_width(std::size_t least) {
  winsize size{};
  if (isatty(STDOUT_FILENO) == 0 || ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0) return least;
  return std::max<std::size_t>(least, size.ws_col);
}

std::sig_atomic_t line_is_open() {
  return open_line;
}

void show_text(std::string_view text) {
  write_results(printed(text));
}

void show_verdicts(std::string_view text) {
  show_judgement(text, report::Tone::plain);
}

void show_judgement(std::string_view text, report::Tone tone) {
  const std::string shown = printed(text);
  write_results(the_terminal().colour == Terminal::Shown::yes ? with_coloured_judgement(shown, tone)
                                                              : shown);
}

void say_text(std::string_view text) {
  if (the_terminal().remarks == Terminal::Shown::yes) write_remark(text, "note");
}

void complain_text(std::string_view text) {
  write_remark(text, "error");
}

void say_json(const std::string& object) {
  if (the_terminal().remarks == Terminal::Shown::yes) write_line(object + "\n");
}

std::string note_line(std::string_view text) {
  return the_terminal().lines == Terminal::Lines::json && !text.empty() ? json_line(text, "note")
                                                                        : std::string(text);
}

void flush_output() {
  if (std::fflush(stdout) != 0) throw OutputLost(errno, std::generic_category());
}

}  // namespace drift::cli
