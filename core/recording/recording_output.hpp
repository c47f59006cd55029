#pragma once

#include <string>
#include <string_view>

#include "core/recording/recording.hpp"

namespace drift {

/// Writes as write_recording() does, into a file that another name is given to when it is complete:
/// `path`, which decides the format and is named in messages.
void write_recording_to(const Recording& recording, const std::string& path,
                        const std::string& temporary);

/// The first fact of every recording that driftscope makes.
inline constexpr std::string_view made_here = "driftscope recording";

/// Why a file is not to be replaced by a recording converted from another, or by a simulated one
/// (nothing given): it is no recording of that origin, or was changed since. In the words of a
/// message; empty if it may be replaced.
std::string not_made_here(const std::string& path, const std::string& converted_from = {});

}  // namespace drift
