#pragma once

#include <string>

#include "mc/engine/engine.hpp"

namespace drift::cli {

/// Reports a study on stderr: a bar that is redrawn on a terminal (auto), a line every 10 s
/// (plain), JSON lines (json), or nothing (none). Done, failed, runs per second, and the time left
/// judged by completed runs.
mc::ProgressSink run_progress(const std::string& style);

}  // namespace drift::cli
