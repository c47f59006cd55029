#include "analysis/cli/read_recordings.hpp"

#include <fmt/format.h>

#include "core/sim/quality_card.hpp"

namespace drift::cli {

std::vector<Recording> read_recordings(const Study& study, const std::vector<std::string>& paths) {
  std::vector<Recording> recordings;
  for (const std::string& path : paths) {
    recordings.push_back(read_recording(path, study.kind, study.site.gravity));
    fmt::print("{}\n", to_text(quality_card(recordings.back(), study.kind)));
  }
  return recordings;
}

}  // namespace drift::cli
