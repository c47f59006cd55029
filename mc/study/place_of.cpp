#include "mc/study/place_of.hpp"

#include <algorithm>

namespace drift::mc {

std::string place_of(const Study& study, const std::string& key) {
  const auto given = std::ranges::find(study.resolved, key, &Resolved::key);
  if (given == study.resolved.end()) return study.path;
  if (given->origin == "--set") return "--set " + key;
  const std::size_t line = given->origin.rfind(':');
  return line == std::string::npos ? study.path : study.path + given->origin.substr(line);
}

}  // namespace drift::mc
