#pragma once

#include <cstdint>
#include <string>

#include "mc/engine/work_session.hpp"
#include "mc/store/manifest.hpp"

namespace drift::cli {

// What `run` says of a study whether it does the work or tells what the work would be.

/// "1 block of runs", "3 blocks of runs".
std::string blocks_text(std::size_t n);

/// " of this worker's part 1/4"; empty where the work is not shared.
std::string part_text(const mc::WorkerShare& share);

/// "this part is empty: the study has 2 blocks of 64 runs, so at most 2 workers can help"; empty
/// where the part is not.
std::string empty_part_text(const mc::WorkerShare& share, const mc::Manifest& manifest,
                            std::uint64_t runs);

/// A note of it.
void say_empty_part(const std::string& folder, const mc::WorkerShare& share,
                    const mc::Manifest& manifest, std::uint64_t runs);

/// A note if more runs per point were asked for before than now.
void say_asked_before(const std::string& folder, std::uint64_t before, std::uint64_t now);

/// Runs per point where the command does not say: what an extension asked for that was broken off.
/// A note says so if `tells`. The folder holds the study.
std::uint64_t runs_to_go_on_to(const std::string& folder, std::uint64_t of_study, bool tells);

}  // namespace drift::cli
