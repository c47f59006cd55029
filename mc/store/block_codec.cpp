#include "mc/store/block_codec.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/base/check.hpp"
#include "core/base/sha256.hpp"

namespace drift::mc {
namespace {

constexpr std::uint64_t reversed(std::uint64_t v) {
  std::uint64_t out = 0;
  for (int i = 0; i < 8; ++i, v >>= 8) out = out << 8 | (v & 0xff);
  return out;
}

constexpr std::uint64_t little_endian(std::uint64_t v) {
  return std::endian::native == std::endian::little ? v : reversed(v);
}

}  // namespace

std::string encode(const Block& block, std::size_t columns) {
  const std::size_t runs = block.status.size();
  DRIFT_DEMAND(block.rows.size() == runs * columns);
  std::string out(runs * (1 + 8 * columns), '\0');
  for (std::size_t r = 0; r < runs; ++r) out[r] = static_cast<char>(block.status[r]);
  char* to = out.data() + runs;
  for (std::size_t c = 0; c < columns; ++c)
    for (std::size_t r = 0; r < runs; ++r, to += 8) {
      const auto bits = little_endian(std::bit_cast<std::uint64_t>(block.rows[r * columns + c]));
      std::memcpy(to, &bits, 8);
    }
  return out;
}

std::optional<Block> decode(const BlockKey& key, std::size_t columns, std::string_view payload) {
  if (payload.size() != key.count * (1 + 8 * columns)) return std::nullopt;
  Block block{key.point, key.first, std::vector<RunStatus>(key.count),
              std::vector<double>(key.count * columns)};
  for (std::size_t r = 0; r < key.count; ++r) {
    const auto code = static_cast<std::uint8_t>(payload[r]);
    if (code > static_cast<std::uint8_t>(RunStatus::error)) return std::nullopt;
    block.status[r] = static_cast<RunStatus>(code);
  }
  const char* from = payload.data() + key.count;
  for (std::size_t c = 0; c < columns; ++c)
    for (std::size_t r = 0; r < key.count; ++r, from += 8) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, from, 8);
      block.rows[r * columns + c] = std::bit_cast<double>(little_endian(bits));
    }
  return block;
}

std::string checksum(std::string_view study_hash, const BlockKey& key, std::string_view payload) {
  Sha256 hash;
  hash.update(study_hash);
  for (const std::uint64_t number :
       {std::uint64_t{key.point}, key.first, std::uint64_t{key.count}}) {
    const auto bits = little_endian(number);
    hash.update(std::string_view(reinterpret_cast<const char*>(&bits), 8));
  }
  hash.update(payload);
  return hash.finish();
}

bool agree(const Block& a, const Block& b) {
  if (a.point != b.point || a.first != b.first) return false;
  const std::size_t runs = std::min(a.status.size(), b.status.size());
  if (runs == 0) return true;
  const std::size_t columns = a.rows.size() / a.status.size();
  if (columns != b.rows.size() / b.status.size()) return false;
  return std::equal(a.status.begin(), a.status.begin() + runs, b.status.begin()) &&
         std::memcmp(a.rows.data(), b.rows.data(), runs * columns * sizeof(double)) == 0;
}

}  // namespace drift::mc
