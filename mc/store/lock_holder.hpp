#pragma once

#include <optional>
#include <string>

namespace drift::mc {

/// The process of this machine that keeps a database file locked for itself.
struct LockHolder {
  int process = 0;
  bool is_stopped = false;  ///< by SIGSTOP or a debugger: it will not go on by itself
};

/// As the kernel lists it; nothing if nobody does, or a process of another machine. The file is not
/// opened for it: closing it would drop what locks this process has on it.
std::optional<LockHolder> lock_holder(const std::string& path);

}  // namespace drift::mc
