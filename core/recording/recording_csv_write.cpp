#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

#include "core/base/seal.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/recording_csv.hpp"
#include "core/recording/recording_output.hpp"

namespace drift {
namespace {

/// The shortest digits that read back, in this unit, as the same value; nothing for NaN.
void append_number(std::string& out, double value, const Unit& unit) {
  if (std::isnan(value)) return;
  const double best = in_unit(value, unit);
  char digits[40], other_digits[40];
  std::size_t size =
      static_cast<std::size_t>(std::to_chars(digits, digits + 40, best).ptr - digits);
  // Where neighbours read back alike, the shorter one is what the file held: 0.035, not
  // 0.0350...01.
  for (const double side : {-HUGE_VAL, HUGE_VAL}) {
    if (unit.to_si == 1.0) break;
    const double other = std::nextafter(best, side);
    if (other * unit.to_si != best * unit.to_si) continue;
    const auto other_size = static_cast<std::size_t>(
        std::to_chars(other_digits, other_digits + 40, other).ptr - other_digits);
    if (other_size >= size) continue;
    size = other_size;
    std::memcpy(digits, other_digits, size);
  }
  out.append(digits, size);
}

}  // namespace

std::string write_csv(const Recording& recording, const Facts& facts, const std::string& path) {
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "we"),
                                                       &std::fclose);
  if (!file) return std::strerror(errno);
  std::string out;
  const auto flush = [&] {
    const bool done = std::fwrite(out.data(), 1, out.size(), file.get()) == out.size();
    out.clear();
    return done;
  };
  for (const auto& [key, value] : facts) {
    out += fmt::format("# {} = {}\n", key, value);
    if (&key == &facts.front().first && key == made_here)
      out += fmt::format("# {} = {}\n", seal_key, open_seal());
  }
  for (const auto& c : recording.channels) {
    if (&c != &recording.channels.front()) out += ',';
    out += c.name;
    const auto quantity = known_quantity(c.name);
    if (!quantity || quantity->needs_unit) out += fmt::format(" [{}]", c.unit.symbol.view());
  }
  out += '\n';
  for (std::size_t i = 0; i < recording.rows(); ++i) {
    for (const auto& c : recording.channels) {
      if (&c != &recording.channels.front()) out += ',';
      append_number(out, c.values[i], c.unit);
    }
    out += '\n';
    if (out.size() > (1u << 18) && !flush()) return std::strerror(errno);
  }
  if (!flush() || std::fclose(file.release()) != 0) return std::strerror(errno);
  return {};
}

}  // namespace drift
