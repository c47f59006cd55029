#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mc/engine/rule_follower.hpp"
#include "mc/store/study_reader.hpp"

namespace drift::mc {

/// What of a study the worker files list. Without stop rules no block is read for it: a worker's
/// start costs next to nothing however much others have stored. What is listed may be damaged all
/// the same; verify_stored() tells.
struct Listed {
  std::uint64_t runs = 0, failed = 0;  ///< in blocks as long as they are asked for
  std::uint64_t cut_short = 0;         ///< runs in blocks that a shorter study ended within
  std::vector<std::uint64_t> missing;  ///< numbers of blocks, of `all`, whose point has not enough
};

/// `all`: all_blocks() of the study.
Listed list_stored(StudyReader& reader, const std::vector<BlockKey>& all,
                   const RuleFollower& rules);

/// What the results of a study are, every block read once and its checksum compared.
struct Verified {
  std::uint64_t results = 0, failed = 0;  ///< runs
  std::string digest;                     ///< results_digest()
  std::vector<std::uint64_t> missing;     ///< numbers of blocks that are damaged or not there
};

Verified verify_stored(StudyReader& reader, const std::vector<BlockKey>& all,
                       const RuleFollower& follower, const StopRules& rules);

}  // namespace drift::mc
