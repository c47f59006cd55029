#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mc/engine/engine.hpp"
#include "mc/store/block_codec.hpp"

namespace drift::mc {

/// What a session would find of a study and do, were it begun now.
struct Forecast {
  std::uint64_t stored = 0;        ///< runs of those asked for, whole
  std::uint64_t beyond = 0;        ///< runs listed besides, that a longer study asked for
  std::uint64_t cut_short = 0;     ///< runs in blocks that a shorter study ended within: done anew
  std::uint64_t kept = 0;          ///< runs of unfinished blocks that it would go on from
  std::uint64_t asked_before = 0;  ///< per point, the most asked for before; 0: the study is new
  std::vector<BlockKey> own;       ///< to execute; where there are stop rules, at most
  std::size_t others = 0;          ///< blocks missing of the other workers' parts
  std::vector<std::string> notes;  ///< damage found
};

/// Reads all that is stored and writes nothing. `manifest` is that of the study, `begun` what
/// require_claimable() said of it, `worker` the number of the file that the session would write.
/// InputError: store if another process is at work as this worker, io.
Forecast forecast(const StudyWork& work, const EngineOptions& options, const std::string& folder,
                  const Manifest& manifest, bool begun, std::size_t worker);

}  // namespace drift::mc
