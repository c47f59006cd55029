#pragma once

#include <string>

#include "core/base/check.hpp"

namespace drift {

/// Memory that this process can still get [bytes]: the least of what is free on the machine, in its
/// control group and below its limits.
double available_memory();

/// InputError if a job needs more memory than there is, before it is begun. `what`: what needs it,
/// with its file, for the message; `remedy`: what to do.
void require_memory(double bytes, ExitCode code, const std::string& what,
                    const std::string& remedy);

}  // namespace drift
