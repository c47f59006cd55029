#include "core/base/seal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>

#include "core/base/atomic_file.hpp"
#include "core/base/sha256.hpp"

namespace drift {
namespace {

constexpr std::size_t digits = 64;
constexpr std::streamoff head = 1 << 17, tail = 256;  // where it is looked for [bytes]

/// A digest as it stands in a file.
struct Seal {
  std::streamoff at = 0;
  std::string text;
};

/// The digest in a part of a file that begins at `from`.
std::optional<Seal> seal_within(std::ifstream& file, std::streamoff from, std::streamoff size) {
  std::string part(static_cast<std::size_t>(size), '\0');
  file.seekg(from);
  if (!file.read(part.data(), size)) return {};
  for (std::size_t at = 0; (at = part.find(seal_key, at)) != std::string::npos;) {
    at += seal_key.size();
    const std::size_t begin = part.find_first_not_of("\"=: ", at);
    if (begin == std::string::npos || begin - at > 4) continue;
    const std::string text = part.substr(begin, digits);
    if (text.size() == digits && text.find_first_not_of("0123456789abcdef") == std::string::npos)
      return Seal{from + static_cast<std::streamoff>(begin), text};
  }
  return {};
}

std::optional<Seal> seal_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) return {};
  const std::streamoff size = file.tellg(), last = std::min(size, tail);
  // The end first: what a binary file holds at its beginning may look alike.
  if (auto seal = seal_within(file, size - last, last)) return seal;
  return seal_within(file, 0, std::min(size, head));
}

/// Feeds the next bytes of a file to a sum, a piece at a time: a file may be larger than memory.
/// How many there were, at most `most`.
std::streamoff feed(Sha256& sum, std::ifstream& file, std::streamoff most) {
  std::string piece(std::size_t{1} << 18, '\0');
  std::streamoff fed = 0;
  while (fed < most) {
    file.read(piece.data(), std::min(most - fed, static_cast<std::streamoff>(piece.size())));
    if (file.gcount() == 0) break;
    sum.update(std::string_view(piece).substr(0, static_cast<std::size_t>(file.gcount())));
    fed += file.gcount();
  }
  return fed;
}

/// SHA-256 of a file with zeros in place of its digest; empty if it cannot be read.
std::string digest_without(const std::string& path, const Seal& seal) {
  std::ifstream file(path, std::ios::binary);
  Sha256 sum;
  if (feed(sum, file, seal.at) < seal.at) return {};
  sum.update(open_seal());
  file.seekg(seal.at + static_cast<std::streamoff>(digits));
  feed(sum, file, std::numeric_limits<std::streamoff>::max());
  return file.bad() ? std::string() : to_hex(sum.finish());
}

}  // namespace

std::string open_seal() {
  return std::string(digits, '0');
}

void close_seal(const std::string& file, const std::string& path) {
  const auto seal = seal_of(file);
  const std::string digest = seal ? digest_without(file, *seal) : std::string();
  if (digest.empty()) throw_cannot_write(path, "it does not read back as written");
  std::fstream out(file, std::ios::binary | std::ios::in | std::ios::out);
  out.seekp(seal->at);
  if (!(out << digest << std::flush)) throw_cannot_write(path, std::strerror(errno));
}

void append_seal(const std::string& file, const std::string& path) {
  std::ofstream out(file, std::ios::binary | std::ios::app);
  if (!(out << fmt::format("# {} = {}\n", seal_key, open_seal()) << std::flush))
    throw_cannot_write(path, std::strerror(errno));
  out.close();
  close_seal(file, path);
}

bool seal_holds(const std::string& file) {
  const auto seal = seal_of(file);
  return seal && digest_without(file, *seal) == seal->text;
}

}  // namespace drift
