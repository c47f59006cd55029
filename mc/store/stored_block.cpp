#include "mc/store/stored_block.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>

namespace drift::mc {

std::uint64_t runs_of(const std::vector<StoredBlock>& blocks) {
  std::uint64_t runs = 0;
  for (const StoredBlock& b : blocks) runs += b.block.status.size();
  return runs;
}

std::string encode(const std::vector<Failure>& failures) {
  std::string out;
  for (const Failure& f : failures)
    out += fmt::format("{} {} {:016x} {} {}\n", f.run, static_cast<int>(f.status),
                       std::isnan(f.t) ? 0 : std::bit_cast<std::uint64_t>(f.t), f.cause.size(),
                       f.cause);
  return out;
}

void Moments::add(double value) {
  ++n;
  const double delta = value - mean;
  mean += delta / static_cast<double>(n);
  m2 += delta * (value - mean);
}

void Moments::merge(const Moments& later) {
  if (later.n == 0) return;
  if (n == 0) {
    *this = later;
    return;
  }
  const auto a = static_cast<double>(n), b = static_cast<double>(later.n);
  const double delta = later.mean - mean;
  m2 += later.m2 + delta * delta * a * b / (a + b);
  mean += delta * b / (a + b);
  n += later.n;
}

Moments moments(const Block& block, std::size_t column, std::size_t columns) {
  Moments m;
  for (std::size_t r = 0; r < block.status.size(); ++r) {
    const double value = block.rows[r * columns + column];
    if (block.status[r] == RunStatus::ok && std::isfinite(value)) m.add(value);
  }
  return m;
}

}  // namespace drift::mc
