#pragma once

#include <exception>

namespace drift::cli {

/// Says on stderr what ended a command, each kind of error as what it is; the exit code for it.
int tell_error(const std::exception_ptr& error);

}  // namespace drift::cli
