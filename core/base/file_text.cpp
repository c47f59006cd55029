#include "core/base/file_text.hpp"

#include <fstream>
#include <ios>
#include <iterator>

#include "core/base/check.hpp"

namespace drift {

std::optional<std::string> file_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  try {
    return std::string(std::istreambuf_iterator<char>(file), {});
  } catch (const std::ios_base::failure& failure) {  // the disk, in the middle of it
    throw_cannot_read(path.string(), failure.code().message());
  }
}

void throw_cannot_read(const std::string& path, const std::string& reason) {
  throw InputError(ExitCode::io,
                   fmt::format("{}: cannot be read: {} (expected a file that can be read to its "
                               "end). Nothing was changed; check the disk and the permissions",
                               path, reason));
}

}  // namespace drift
