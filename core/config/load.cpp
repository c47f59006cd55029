#include "core/config/load.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/base/check.hpp"

namespace drift::config {
namespace {

constexpr std::size_t largest_file = 4u << 20;

[[noreturn]] void refuse(const std::string& path, int line, int column, const std::string& text) {
  throw InputError(ExitCode::config, fmt::format("{}:{}:{}: {}", path, line, column, text));
}

struct File {
  int descriptor;
  ~File() {
    if (descriptor >= 0) ::close(descriptor);
  }
};

void check_encoding(const std::string& path, const std::string& text) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    refuse(path, 1, 1, "the file is UTF-16 (expected UTF-8 text). Save it as UTF-8");
  int line = 1;
  std::size_t start = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\0')
      refuse(path, line, static_cast<int>(i - start) + 1,
             "a NUL byte (expected UTF-8 text). Check that this is a study file, and save it as "
             "UTF-8");
    if (text[i] == '\n') {
      ++line;
      start = i + 1;
    }
  }
}

}  // namespace

std::string load_text(const std::string& path) {
  // Without O_NONBLOCK a named pipe would wait for a writer forever.
  const File file{::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)};
  if (file.descriptor < 0)
    refuse(path, 1, 1,
           fmt::format("cannot be opened: {} (expected a readable study file). Check the path and "
                       "its permissions",
                       std::strerror(errno)));
  struct stat status {};
  if (::fstat(file.descriptor, &status) != 0 || !S_ISREG(status.st_mode))
    refuse(path, 1, 1,
           fmt::format("is {} (expected a regular file). Give the path of a study file",
                       S_ISDIR(status.st_mode) ? "a directory" : "a pipe, socket or device"));
  if (status.st_size > static_cast<off_t>(largest_file))
    refuse(path, 1, 1,
           fmt::format("is {} bytes long (expected at most {}). A study file is a few kilobytes: "
                       "check the path",
                       status.st_size, largest_file));
  std::string text(static_cast<std::size_t>(status.st_size), '\0');
  std::size_t have = 0;
  while (have < text.size()) {
    const auto got = ::read(file.descriptor, text.data() + have, text.size() - have);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0)
      refuse(path, 1, 1,
             fmt::format("cannot be read: {} (expected a readable study file). Check the disk",
                         std::strerror(errno)));
    if (got == 0) break;
    have += static_cast<std::size_t>(got);
  }
  text.resize(have);
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);  // a byte order mark some editors write
  check_encoding(path, text);
  return text;
}

}  // namespace drift::config
