#include "mc/store/file_version.hpp"

#include <sys/stat.h>

#include <array>
#include <filesystem>
#include <fstream>

namespace drift::mc {

FileVersion version_of(const std::string& path) {
  constexpr std::streamoff counter_at = 24;  // of four bytes, the highest first
  FileVersion version;
  std::error_code none;
  version.changing = std::filesystem::exists(path + "-journal", none);
  if (const auto bytes = std::filesystem::file_size(path, none); !none) version.bytes = bytes;
  std::ifstream file(path, std::ios::binary);
  std::array<char, 4> counter{};
  if (file.seekg(counter_at) && file.read(counter.data(), counter.size()))
    for (const char byte : counter)
      version.changes = version.changes << 8 | static_cast<unsigned char>(byte);
  return version;
}

FileIdentity identity_of(const std::string& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0) return {};
  return {info.st_dev, info.st_ino};
}

}  // namespace drift::mc
