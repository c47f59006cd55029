#include "mc/store/lock_holder.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

namespace drift::mc {
namespace {

/// "1234 (name) T ...": the name may hold blanks and brackets, the letter follows the last one.
bool is_stopped(int process) {
  std::ifstream file(fmt::format("/proc/{}/stat", process));
  std::string line;
  std::getline(file, line);
  const auto name_end = line.rfind(") ");
  if (name_end == std::string::npos || name_end + 2 >= line.size()) return false;
  const char state = line[name_end + 2];
  return state == 'T' || state == 't';
}

}  // namespace

std::optional<LockHolder> lock_holder(const std::string& path) {
  struct stat file {};
  if (::stat(path.c_str(), &file) != 0) return std::nullopt;
  const std::string wanted =
      fmt::format("{:02x}:{:02x}:{}", major(file.st_dev), minor(file.st_dev), file.st_ino);
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    // "12: POSIX  ADVISORY  WRITE 1234 08:01:131 1073741826 1073742335"
    std::istringstream words(line);
    std::string number, kind, strength, mode, inode;
    int process = 0;
    words >> number >> kind >> strength >> mode >> process >> inode;
    if (kind == "POSIX" && mode == "WRITE" && inode == wanted && process > 0 &&
        process != ::getpid())
      return LockHolder{process, is_stopped(process)};
  }
  return std::nullopt;
}

}  // namespace drift::mc
