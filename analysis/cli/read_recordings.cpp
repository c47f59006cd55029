#include "analysis/cli/read_recordings.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "analysis/cli/print.hpp"
#include "core/base/check.hpp"
#include "core/recording/rows/quality_card.hpp"

namespace drift::cli {

std::vector<Recording> read_recordings(const mc::Study& study,
                                       const std::vector<std::string>& paths) {
  for (std::size_t k = 0; k < paths.size(); ++k)
    for (std::size_t before = 0; before < k; ++before)
      if (std::error_code unknown; std::filesystem::equivalent(paths[k], paths[before], unknown))
        throw InputError(
            ExitCode::usage,
            fmt::format("{}: given twice (expected recordings of different tests: one and the same "
                        "is no further evidence). Name it once",
                        paths[k]));
  std::vector<Recording> recordings;
  for (const std::string& path : paths) {
    recordings.push_back(read_recording(path, study.recording, study.kind, study.site.gravity));
    show("{}\n", to_text(quality_card(recordings.back(), study.kind)));
  }
  return recordings;
}

}  // namespace drift::cli
