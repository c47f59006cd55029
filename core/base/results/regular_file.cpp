#include "core/base/results/regular_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/base/check.hpp"

namespace drift {

std::string other_than_file(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  switch (fs::symlink_status(path, error).type()) {
    case fs::file_type::directory:
      return "a directory";
    case fs::file_type::block:
    case fs::file_type::character:
      return "a device";
    case fs::file_type::fifo:
      return "a pipe";
    case fs::file_type::socket:
      return "a socket";
    case fs::file_type::symlink:
      return "a symbolic link";
    default:
      return {};
  }
}

void require_regular_file_of_ours(const std::string& path) {
  if (const std::string what = other_than_file(path); !what.empty())
    throw InputError(
        ExitCode::store,
        fmt::format("{}: is {}{} (expected a file of its own). Nothing was changed; move it away "
                    "or put a copy of the file in its place, or give another folder",
                    path, what, what == "a symbolic link" ? ", which is not followed" : ""));
  // Not opened to see: closing it again would let go of locks that this process has on it.
  if (::faccessat(AT_FDCWD, path.c_str(), R_OK, AT_EACCESS) != 0 && errno != ENOENT &&
      errno != ENOTDIR)
    throw InputError(ExitCode::io,
                     fmt::format("{}: cannot be read: {} (expected a file of driftscope). Nothing "
                                 "was changed; check the path and its permissions",
                                 path, std::strerror(errno)));
}

}  // namespace drift
