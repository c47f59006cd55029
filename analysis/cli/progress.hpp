#pragma once

#include <functional>
#include <memory>
#include <string>

namespace drift::cli {

inline constexpr double plain_interval = 10.0;  ///< between plain lines [s]

/// "34 s", "3 min 20 s", "2 h 5 min", or "unknown".
std::string duration_text(double seconds);

/// Whether a line that is redrawn stays.
enum class LineEnd { redrawn, last };

/// The line of a bar on a terminal's stderr, over the one before it: "what [####----] words".
void redraw_progress(const std::string& what, double done, const std::string& words,
                     LineEnd line_end);

/// Whether progress of this style is such a line.
bool progress_is_redrawn(const std::string& style);

/// Reports progress on stderr: a bar that is redrawn on a terminal, plain lines elsewhere, JSON
/// lines, or nothing. Done, total and the time left, judged by what is completed. Thread-safe.
std::function<void(std::size_t, std::size_t)> progress_reporter(const std::string& style,
                                                                const std::string& what);

/// The same for a job of unlike stages: the stage and the part of the whole that is done (0 .. 1).
/// Plain lines come with every stage.
std::function<void(const std::string&, double)> stage_reporter(const std::string& style,
                                                               const std::string& what);

}  // namespace drift::cli
