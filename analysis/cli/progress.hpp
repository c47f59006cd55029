#pragma once

#include <functional>
#include <memory>
#include <string>

namespace drift::cli {

inline constexpr double plain_interval = 10.0;  ///< between plain lines [s]

/// Reports progress on stderr: a line that is redrawn on a terminal, plain lines elsewhere, JSON
/// lines, or nothing. Done, total and the time left, judged by what is completed. Thread-safe.
std::function<void(std::size_t, std::size_t)> progress_reporter(const std::string& style,
                                                                const std::string& what);

/// The same for a job of unlike stages: the stage and the part of the whole that is done (0 .. 1).
/// Plain lines come with every stage.
std::function<void(const std::string&, double)> stage_reporter(const std::string& style,
                                                               const std::string& what);

}  // namespace drift::cli
