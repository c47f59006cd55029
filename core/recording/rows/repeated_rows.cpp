#include "core/recording/rows/repeated_rows.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "core/recording/recording_channels.hpp"

namespace drift {
namespace {

constexpr std::size_t window = 5;            // rows by which a stretch is found
constexpr std::size_t most_kept = 100'000;   // windows that are remembered, about
constexpr std::size_t most_weighed = 1'000;  // rows: a longer stretch is no less likely than these

std::uint64_t mixed(std::uint64_t h, std::uint64_t x) {
  h = (h ^ x) * 0x9E3779B97F4A7C15ULL;
  return h ^ (h >> 29);
}

/// A reading to nine digits: the rate that a file of increments gives differs in the last ones.
std::uint64_t reading(double x) {
  if (std::isnan(x)) return ~std::uint64_t{0};
  constexpr std::uint64_t half = std::uint64_t{1} << 21;
  return (std::bit_cast<std::uint64_t>(x + 0.0) + half) & ~(2 * half - 1);  // -0 is 0
}

class Repeats {
 public:
  explicit Repeats(const Recording& r) : n_(r.rows()) {
    for (const ChannelTriple* triple : {&accelerometer_channels, &gyro_channels}) add(r, *triple);
    if (channels_.empty()) add(r, gimbal_channels);
    if (const Channel* position = r.find("position")) positions_ = &position->values;
    hashes_.assign(n_, 0);
    for (const Reading& c : channels_)
      for (std::size_t row = 0; row < n_; ++row)
        hashes_[row] = mixed(hashes_[row], reading((*c.values)[row]));
  }

  std::vector<RepeatedRows> find() const {
    std::vector<RepeatedRows> all;
    if (channels_.empty()) return all;
    const std::uint64_t every = 1 + n_ / most_kept;
    std::unordered_map<std::uint64_t, std::size_t> seen;
    std::size_t done = 0;
    for (std::size_t row = 0; row + window <= n_;) {
      const std::uint64_t hash = hash_of_window(row);
      std::size_t next = row + 1;
      if (hash % every == 0) {
        const auto [at, fresh] = seen.try_emplace(hash, row);
        if (!fresh) {
          const RepeatedRows found = extended(at->second, row, done, 64 * every);
          const std::size_t end = found.again + found.count;
          if (is_no_chance(found)) {
            all.push_back(found);
            next = done = end;
          } else if (end > row + window) {
            next = end - window + 1;  // of what stands still, every row repeats the one before
          }
        }
      }
      row = next;
    }
    return all;
  }

 private:
  struct Reading {
    const std::vector<double>* values;
    double step;  ///< decimal_step()
  };

  void add(const Recording& r, const ChannelTriple& triple) {
    for (const auto name : triple.names)
      if (const Channel* c = r.find(name)) channels_.push_back({&c->values, decimal_step(*c)});
  }

  std::uint64_t hash_of_window(std::size_t row) const {
    std::uint64_t h = 1;
    for (std::size_t i = 0; i < window; ++i) h = mixed(h, hashes_[row + i]);
    return h;
  }

  bool alike(std::size_t a, std::size_t b) const {
    return hashes_[a] == hashes_[b] && std::ranges::all_of(channels_, [&](const Reading& c) {
             return reading((*c.values)[a]) == reading((*c.values)[b]);
           });
  }

  /// The stretch around two rows that are alike: not back into rows that are said already, nor by
  /// more than `back`, nor so far that it would repeat itself.
  RepeatedRows extended(std::size_t first, std::size_t again, std::size_t done,
                        std::size_t back) const {
    const std::size_t apart = again - first;
    while (first > 0 && again > done && back > 0 && alike(first - 1, again - 1)) {
      --first;
      --again;
      --back;
    }
    std::size_t count = 0;
    while (count < apart && again + count < n_ && alike(first + count, again + count)) ++count;
    return {first, again, count};
  }

  /// Minus the logarithm of the chance that a channel makes these rows a second time: of every
  /// reversal, how often its value occurs among them. What reverses are third differences, in which
  /// a drift is gone, by more than rounding can make them.
  double weight(const Reading& channel, const RepeatedRows& found, std::size_t count) const {
    const double* x = channel.values->data() + found.again;
    std::vector<double> sorted(x, x + count);
    std::erase_if(sorted, [](double v) { return std::isnan(v); });
    if (sorted.empty()) return 0.0;
    std::ranges::sort(sorted);
    double step = channel.step;
    if (const double own = step_between(sorted); own > step) step = own;
    constexpr double digits = 1e-12;  // of a number that was computed
    const double rounded =
        4.0 * step + digits * std::max(std::abs(sorted.front()), std::abs(sorted.back()));
    double sum = 0.0;
    for (std::size_t i = 3; i + 1 < count; ++i) {
      if (positions_ && (*positions_)[found.again + i - 3] != (*positions_)[found.again + i + 1])
        continue;
      const double a = x[i] - 3.0 * x[i - 1] + 3.0 * x[i - 2] - x[i - 3],
                   b = x[i + 1] - 3.0 * x[i] + 3.0 * x[i - 1] - x[i - 2];
      if (!(a * b < 0.0 && std::min(std::abs(a), std::abs(b)) > rounded)) continue;
      const auto [first, last] = std::equal_range(sorted.begin(), sorted.end(), x[i]);
      sum += std::log(static_cast<double>(sorted.size()) / static_cast<double>(last - first));
    }
    return sum;
  }

  bool is_no_chance(const RepeatedRows& found) const {
    const std::size_t count = std::min(found.count, most_weighed);
    const auto n = static_cast<double>(n_);
    const double pairs = 0.5 * n * n;
    double sum = 0.0;
    for (const Reading& c : channels_) sum += weight(c, found, count);
    return sum > std::log(pairs / chance_of_repeated_rows);
  }

  std::size_t n_ = 0;
  std::vector<Reading> channels_;
  const std::vector<double>* positions_ = nullptr;
  std::vector<std::uint64_t> hashes_;  // of the readings of a row
};

}  // namespace

double decimal_step(const Channel& c) {
  constexpr double exact = 1e-14;  // of a number: a conversion of units loses less
  double places = 1.0;
  for (int k = 0; k <= 9; ++k, places *= 10.0)
    if (std::ranges::all_of(c.values, [&](double x) {
          const double in_places = x / c.unit.to_si * places;
          return std::isnan(x) || std::abs(in_places - std::round(in_places)) <=
                                      exact * std::max(1.0, std::abs(in_places));
        }))
      return c.unit.to_si / places;
  return 0.0;
}

double step_between(const std::vector<double>& sorted) {
  double least = HUGE_VAL;
  std::size_t distinct = 1;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i] == sorted[i - 1]) continue;
    ++distinct;
    least = std::min(least, sorted[i] - sorted[i - 1]);
  }
  return distinct > 1 && 2 * distinct <= sorted.size() ? least : 0.0;
}

std::vector<RepeatedRows> repeated_rows(const Recording& recording) {
  return Repeats(recording).find();
}

}  // namespace drift
