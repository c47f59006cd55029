#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace drift::cli {

/// What files take on the disk; one that is not there takes nothing.
inline double megabytes_of(const std::vector<std::string>& files) {
  double bytes = 0.0;
  for (const std::string& file : files) {
    std::error_code failed;
    const auto size = std::filesystem::file_size(file, failed);
    if (!failed) bytes += static_cast<double>(size);
  }
  return bytes / 1e6;
}

}  // namespace drift::cli
