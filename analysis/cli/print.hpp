#pragma once

#include <fmt/format.h>

#include <csignal>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include "analysis/report/page/table.hpp"

namespace drift::cli {

/// Standard output took no more: a full disk, or a reader that went away.
struct OutputLost : std::system_error {
  using std::system_error::system_error;
};

/// What of the program's words reaches whom.
struct Terminal {
  enum class Shown { yes, no };
  Shown results = Shown::yes;  ///< what show() prints
  Shown remarks = Shown::yes;  ///< what say() prints
  Shown colour = Shown::no;    ///< of verdicts
  Shown details = Shown::no;   ///< what --full asks for, behind the answer
  Shown json = Shown::no;      ///< the document of an answer in its place, what --json asks for
  enum class Lines { words, json };
  Lines lines = Lines::words;  ///< of standard error; json: each line a JSON object
};

/// The command line, whose names of files are printed as on one line, whatever is in them.
void set_arguments(std::span<char* const> arguments);

/// Set once, before a command runs.
void set_terminal(const Terminal& terminal);
const Terminal& terminal();

/// Said by a command once it knows that files take what was asked for, where the command line alone
/// does not tell (Result): a terminal without remarks shows no results either.
void files_take_results();

/// Columns of the terminal that results go to, at least `least`; that where they go elsewhere.
std::size_t terminal_width(std::size_t least);

/// Not 0 while a line that is redrawn stands on the terminal without an end: whoever prints ends
/// it first. Signal handlers may read it.
std::sig_atomic_t line_is_open();

/// Results, to standard output. What names and titles bring along is shown, not obeyed: control
/// characters and bytes that are not UTF-8 appear as \xNN. OutputLost if it takes no more.
void show_text(std::string_view text);

/// Results with a verdict in them, which has a colour where the terminal shows one.
void show_verdicts(std::string_view text);

/// An answer whose judgement, before the first colon, has the colour of its tone.
void show_judgement(std::string_view text, report::Tone tone);

/// Everything else, to standard error, in the same way; lines beyond all measure are shortened. If
/// nobody takes it, the work goes on all the same.
void say_text(std::string_view text);

/// Errors: as say_text(), but never silenced.
void complain_text(std::string_view text);

/// A line of progress that is a JSON object, to standard error: as it is, or not at all.
void say_json(const std::string& object);

/// What say_text() writes of a text, ended: the text, or {"level": "note", "message": text} where
/// every line is JSON.
std::string note_line(std::string_view text);

template <class... A>
void show(fmt::format_string<A...> text, A&&... arguments) {
  show_text(fmt::format(text, std::forward<A>(arguments)...));
}

template <class... A>
void say(fmt::format_string<A...> text, A&&... arguments) {
  say_text(fmt::format(text, std::forward<A>(arguments)...));
}

template <class... A>
void complain(fmt::format_string<A...> text, A&&... arguments) {
  complain_text(fmt::format(text, std::forward<A>(arguments)...));
}

/// Brings what was printed out of the program. OutputLost.
void flush_output();

}  // namespace drift::cli
