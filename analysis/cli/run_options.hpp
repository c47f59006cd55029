#pragma once

#include <optional>
#include <string>

#include "mc/engine/engine.hpp"

namespace drift::cli {

/// "3/16": worker 3 of 16, counted from 0; "auto", "auto/16": as the batch system says. InputError
/// (usage).
mc::WorkerShare parse_share(const std::string& text);

/// "55m", "1h30m", "90 s", "45" (seconds) -> seconds. InputError (usage) names the option.
double parse_duration(const std::string& option, const std::string& text);

/// "1%" or "0.01" -> 0.01. InputError (usage).
double parse_fraction(const std::string& option, const std::string& text);

}  // namespace drift::cli
