#pragma once

#include <string>
#include <utility>
#include <vector>

namespace drift {

/// What this program was made from and with.
struct BuildInfo {
  std::string version, commit;
  std::string build_type, compiler, flags;
  std::string instruction_set;  ///< the widest one it was compiled for
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name, version
};

const BuildInfo& build_info();

/// Twelve hexadecimal digits that differ where exp, log, sin, cos, atan2 or pow of this machine
/// give other bits: the C library chooses them by the CPU when the program starts, so that one
/// program may compute differently on two machines.
const std::string& arithmetic_fingerprint();

}  // namespace drift
