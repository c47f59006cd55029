#include "core/recording/recording_files.hpp"

#include <algorithm>
#include <filesystem>

#include "core/base/sha256.hpp"
#include "core/recording/isolated.hpp"
#include "core/recording/recording_hdf5.hpp"
#include "core/recording/recording_mat.hpp"

namespace drift {

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::ranges::transform(extension, extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  });
  return extension;
}

bool is_text_file(const std::string& path) {
  constexpr std::string_view all[] = {".csv", ".txt", ".dat", ".tsv"};
  return std::ranges::find(all, extension_of(path)) != std::end(all);
}

bool is_binary_file(const std::string& path) {
  constexpr std::string_view all[] = {".h5", ".hdf5", ".mat"};
  return std::ranges::find(all, extension_of(path)) != std::end(all);
}

RawRecording read_binary(const std::string& path, Problems& problems) {
  RawRecording raw =
      read_isolated(path, problems, extension_of(path) == ".mat" ? read_mat : read_hdf5);
  // Their libraries call a disk that cannot be read a damaged file.
  if (problems.count() > 0) sha256_hex_of_file(path);
  return raw;
}

}  // namespace drift
