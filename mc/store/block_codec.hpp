#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "mc/task/run_task.hpp"

namespace drift::mc {

/// Which block: its study point, its first run, the number of its runs.
struct BlockKey {
  std::size_t point = 0;
  std::uint64_t first = 0;
  std::size_t count = 0;
  auto operator<=>(const BlockKey&) const = default;
};

inline BlockKey key_of(const Block& block) {
  return {block.point, block.first, block.status.size()};
}

/// The results of a block as they are stored, the same bytes on every machine: one byte of status
/// per run, then column after column, each value as little-endian IEEE double.
std::string encode(const Block& block, std::size_t columns);

/// The reverse; nothing if the size does not fit or a status is none.
std::optional<Block> decode(const BlockKey& key, std::size_t columns, std::string_view payload);

/// SHA-256 over the study's hash, the key and the payload: a block that was damaged, moved or taken
/// from another study does not fit.
std::string checksum(std::string_view study_hash, const BlockKey& key, std::string_view payload);

/// The runs that two blocks of the same first run have in common are equal, bit for bit.
bool agree(const Block& a, const Block& b);

}  // namespace drift::mc
