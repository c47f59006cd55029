#include "core/recording/rows/shared_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <unordered_map>

#include "core/recording/recording_channels.hpp"
#include "core/recording/rows/reading_step.hpp"
#include "core/recording/rows/repeated_rows.hpp"

namespace drift {
namespace {

constexpr std::array agreements{1e-9, 1e-7, 1e-6};  // of the largest reading of a triple
constexpr double searches = 2.0 * agreements.size();
constexpr std::size_t most_alike = 64;  // rows of the same readings that a row is held against
constexpr std::size_t probed = 4;  // one noisy row of so many: a stretch is found by any of its own
constexpr std::size_t most_keyed = 3;  // channels by which rows are looked up

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// A channel that both recordings have.
struct Both {
  const std::vector<double>*a, *b;
  double largest = 0.0;  ///< reading of the channels of its triple
  double step = 0.0;     ///< shown_step() of both
};

std::vector<Both> in_both(const Recording& a, const Recording& b,
                          std::span<const ChannelTriple> triples) {
  std::vector<Both> all;
  for (const ChannelTriple& triple : triples) {
    std::vector<Both> some;
    double largest = 0.0;
    for (const auto name : triple.names)
      if (const Channel* p = a.find(name), *q = b.find(name); p && q) {
        some.push_back(
            {&p->values, &q->values, 0.0, std::max(shown_step(a, *p), shown_step(b, *q))});
        largest = std::max({largest, largest_reading(*p), largest_reading(*q)});
      }
    for (Both& c : some) c.largest = largest;
    if (largest > 0.0) all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

/// The search with readings that agree to one part of the largest.
class Search {
 public:
  Search(const Recording& a, const Recording& b, const std::vector<Both>& channels,
         double agreement)
      : na_(a.rows()), nb_(b.rows()), channels_(channels), agreement_(agreement) {
    if (const Channel* c = b.find("position")) position_ = &c->values;
    if (const Channel* c = b.find("phase")) phase_ = &c->values;
  }

  std::optional<SharedRows> longest() const {
    std::optional<SharedRows> best;
    std::vector<std::size_t> noisy;
    for (std::size_t row = 0; row < nb_; ++row)
      if (std::ranges::any_of(channels_, [&](const Both& c) { return reverses(c, row); }))
        noisy.push_back(row);
    if (noisy.empty()) return best;
    const std::vector<Keyed> rows = keyed_rows();
    std::unordered_map<std::size_t, std::size_t> ends;  // of what was found, by how far apart
    for (std::size_t n = 0; n < noisy.size(); n += probed) {
      const std::size_t row = noisy[n];
      for (const std::uint64_t key : keys_around(row)) {
        auto at = std::ranges::lower_bound(rows, key, {}, &Keyed::key);
        for (std::size_t k = 0; k < most_alike && at != rows.end() && at->key == key; ++k, ++at) {
          std::size_t& end = ends[row + na_ - at->row];
          if (end > row || !alike(at->row, row)) continue;
          const SharedRows found = extended(at->row, row);
          end = found.second + found.count;
          if ((!best || found.count > best->count) && is_no_chance(found)) best = found;
        }
      }
    }
    return best;
  }

 private:
  struct Keyed {
    std::uint64_t key;
    std::size_t row;
  };

  /// How far readings of a channel may be from each other.
  double near(const Both& c) const { return agreement_ * c.largest; }

  /// How far apart readings are the same, or neighbours on the readout's steps.
  double room(const Both& c) const { return std::max(near(c), c.step); }

  std::size_t keyed() const { return std::min(channels_.size(), most_keyed); }

  std::vector<Keyed> keyed_rows() const {
    std::vector<Keyed> rows;
    for (std::size_t row = 0; row < na_; ++row) {
      std::uint64_t key = 0;
      bool measured = true;
      for (std::size_t k = 0; k < keyed(); ++k) {
        const double cell = (*channels_[k].a)[row] / (2.0 * near(channels_[k]));
        measured = measured && std::isfinite(cell);
        if (measured) key = joined(key, std::floor(cell));
      }
      if (measured) rows.push_back({key, row});
    }
    std::ranges::sort(rows, [](const Keyed& x, const Keyed& y) {
      return x.key != y.key ? x.key < y.key : x.row < y.row;
    });
    return rows;
  }

  /// Of the cells that hold all readings near those of a row.
  std::vector<std::uint64_t> keys_around(std::size_t row) const {
    std::vector<std::uint64_t> keys{0};
    for (std::size_t k = 0; k < keyed(); ++k) {
      const double cell = (*channels_[k].b)[row] / (2.0 * near(channels_[k]));
      if (!std::isfinite(cell)) return {};
      const double own = std::floor(cell), other = cell - own < 0.5 ? own - 1.0 : own + 1.0;
      std::vector<std::uint64_t> more;
      for (const std::uint64_t key : keys) {
        more.push_back(joined(key, own));
        more.push_back(joined(key, other));
      }
      keys = std::move(more);
    }
    return keys;
  }

  static std::uint64_t joined(std::uint64_t key, double cell) {
    const auto number = static_cast<std::uint64_t>(static_cast<std::int64_t>(cell));
    key = (key ^ number) * 0x9E3779B97F4A7C15ULL;
    return key ^ (key >> 29);
  }

  bool alike(std::size_t i, std::size_t j) const {
    return std::ranges::all_of(channels_, [&](const Both& c) {
      const double x = (*c.a)[i], y = (*c.b)[j];
      return std::abs(x - y) <= near(c) || (std::isnan(x) && std::isnan(y));
    });
  }

  SharedRows extended(std::size_t i, std::size_t j) const {
    while (i > 0 && j > 0 && alike(i - 1, j - 1)) --i, --j;
    std::size_t count = 0;
    while (i + count < na_ && j + count < nb_ && alike(i + count, j + count)) ++count;
    return {i, j, count};
  }

  /// Whether the rows of the third differences that end at `row` and behind it are of one rest.
  bool rests(std::size_t row) const {
    if (row < 3 || row + 1 >= nb_) return false;
    if (position_ && (*position_)[row - 3] != (*position_)[row + 1]) return false;
    return !phase_ || std::all_of(&(*phase_)[row - 3], &(*phase_)[row + 1] + 1,
                                  [](double p) { return p == 0.0; });
  }

  /// Whether a reading shows noise: what a drift does is gone in third differences.
  bool reverses(const Both& c, std::size_t row) const {
    if (!rests(row)) return false;
    const double x = third_difference(*c.b, row), y = third_difference(*c.b, row + 1);
    return x * y < 0.0 && std::min(std::abs(x), std::abs(y)) > 4.0 * room(c);
  }

  /// Minus the logarithm of the chance that noise makes the readings of a channel once more.
  double weight(const Both& c, const SharedRows& found) const {
    std::vector<double> differences;
    double reversals = 0.0;
    for (std::size_t row = found.second + 3; row + 1 < found.second + found.count; ++row) {
      if (!rests(row)) continue;
      if (const double d = third_difference(*c.b, row); std::isfinite(d))
        differences.push_back(std::abs(d));
      reversals += reverses(c, row) ? 1.0 : 0.0;
    }
    if (reversals == 0.0) return 0.0;
    constexpr double of_noise = 0.67448975 * 4.47213595;  // median |d| of noise 1: 1 + 9 + 9 + 1
    const double sigma = median(std::move(differences)) / of_noise;
    return -reversals * std::log(std::erf(room(c) / (2.0 * sigma)));
  }

  bool is_no_chance(const SharedRows& found) const {
    const double pairs = static_cast<double>(na_) * static_cast<double>(nb_);
    double sum = 0.0;
    for (const Both& c : channels_) sum += weight(c, found);
    return sum > std::log(searches * pairs / chance_of_repeated_rows);
  }

  std::size_t na_, nb_;
  const std::vector<Both>& channels_;
  double agreement_;
  const std::vector<double>*position_ = nullptr, *phase_ = nullptr;  // of b
};

}  // namespace

std::optional<SharedRows> shared_rows(const Recording& a, const Recording& b) {
  constexpr std::array sensors{accelerometer_channels, gyro_channels};
  constexpr std::array angles{gimbal_channels};
  for (const std::span<const ChannelTriple> triples :
       {std::span<const ChannelTriple>(sensors), std::span<const ChannelTriple>(angles)}) {
    const std::vector<Both> channels = in_both(a, b, triples);
    for (const double agreement : agreements)
      if (const auto found = Search(a, b, channels, agreement).longest()) return found;
  }
  return std::nullopt;
}

}  // namespace drift
