#include "analysis/identification/recording_names.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <set>

namespace drift::identification {

std::vector<std::string> recording_names(const std::vector<Recording>& recordings) {
  if (recordings.size() < 2) return {};
  std::vector<std::string> files, paths;
  for (const Recording& r : recordings) {
    paths.push_back(r.source.empty() ? fmt::format("recording {}", paths.size() + 1) : r.source);
    files.push_back(std::filesystem::path(paths.back()).filename().string());
  }
  return std::set<std::string>(files.begin(), files.end()).size() == files.size() ? files : paths;
}

}  // namespace drift::identification
