#include "core/recording/rows/shared_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "core/recording/recording_channels.hpp"
#include "core/recording/rows/reading_step.hpp"
#include "core/recording/rows/reduce.hpp"
#include "core/recording/rows/repeated_rows.hpp"
#include "core/stats/median.hpp"

namespace drift {
namespace {

constexpr double least_excess = 0.35;  // a reading and the mean of four have 0.48
constexpr double no_noise = 1e-8;      // of the largest reading
constexpr double same_time = 0.01;     // [rows of the finer one]
constexpr int shifted_rows = 64;       // of the finer one, by which clocks are shifted at most
constexpr std::size_t few_signs = 50;  // whose scatter by chance is not known
constexpr std::size_t enough_meetings = 1300;
constexpr std::size_t nothing_shared =
    4;  // third differences of white noise so far from each other

enum class Taken { as_read, as_means };

/// Rows of both that end at one time, at rest.
struct Meeting {
  std::size_t finer, coarser;
};

/// A channel that both have.
struct Heard {
  const std::vector<double>*finer, *coarser;
  double least = 0.0;  ///< third difference that rounding does not make
};
using HeardTriple = std::vector<Heard>;

constexpr signed char no_side = 0;

/// To which side a reading lies where noise turns about: the sign of its third difference, the next
/// one has the other; else no_side. A course bends on to one side.
signed char side(const std::vector<double>& x, std::size_t k, double least) {
  const double d = third_difference(x, k), next = third_difference(x, k + 1);
  if (!(d * next < 0.0 && std::min(std::abs(d), std::abs(next)) > least)) return no_side;
  return d > 0.0 ? 1 : -1;
}

/// How often sides are the same.
struct Agreement {
  std::size_t signs = 0;  ///< of readings that lie to a side in both
  double excess = 0.0;    ///< of same ones over others, as a part of all
  double sigmas = 0.0;    ///< by its scatter at other alignments; 0: not looked at
};

Agreement agreement_of(const std::vector<signed char>& u, const std::vector<signed char>& v) {
  const std::size_t n = u.size();
  std::vector<signed char> twice = v;
  twice.insert(twice.end(), v.begin(), v.end());
  const auto sum_at = [&](std::size_t shift) {
    int sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += u[i] * twice[i + shift];
    return static_cast<double>(sum);
  };
  Agreement found;
  for (std::size_t i = 0; i < n; ++i) found.signs += u[i] * v[i] != 0 ? 1 : 0;
  if (found.signs < few_signs) return found;
  const auto signs = static_cast<double>(found.signs);
  found.excess = sum_at(0) / signs;
  if (found.excess < least_excess) return found;
  double squares = 0.0, alignments = 0.0;
  for (std::size_t shift = nothing_shared; shift + nothing_shared <= n; ++shift, alignments += 1.0)
    squares += std::pow(sum_at(shift), 2);
  // Signs that have nothing in common scatter by the root of their number.
  found.sigmas = sum_at(0) / std::sqrt(std::max(squares / alignments, signs));
  return found;
}

class Listening {
 public:
  Listening(const Recording& finer, const Recording& coarser, double finer_interval,
            double coarser_interval)
      : finer_(finer),
        coarser_(coarser),
        interval_(finer_interval),
        rows_(static_cast<int>(
            std::min<double>(shifted_rows, std::round(coarser_interval / finer_interval)))) {
    for (const ChannelTriple* triple : {&accelerometer_channels, &gyro_channels, &gimbal_channels})
      hear(*triple);
  }

  std::optional<SharedNoise> find() const {
    const std::set<double> all = shifts();
    const double searches = 2.0 * static_cast<double>(triples_.size() * all.size());
    std::optional<SharedNoise> best;  // rows of one log meet those beside them, too
    for (const double shift : all)
      if (const auto found = with_shift(shift, chance_of_repeated_rows / searches))
        if (!best || found->alike > best->alike) best = found;
    return best;
  }

 private:
  void hear(const ChannelTriple& triple) {
    HeardTriple heard;
    double largest = 0.0;
    for (const auto name : triple.names) {
      const Channel *p = finer_.find(name), *q = coarser_.find(name);
      if (p == nullptr || q == nullptr) continue;
      heard.push_back({&p->values, &q->values,
                       4.0 * std::max(shown_step(finer_, *p), shown_step(coarser_, *q))});
      largest = std::max({largest, largest_reading(*p), largest_reading(*q)});
    }
    for (Heard& c : heard) c.least = std::max(c.least, 4.0 * no_noise * largest);
    if (!heard.empty()) triples_.push_back(std::move(heard));
  }

  /// What the clock of the coarser one may lack: nothing, or what makes positions end together, the
  /// last rows of some of them left out.
  std::set<double> shifts() const {
    const auto ends_of = [](const Recording& r) {
      std::map<double, double> ends;
      for (std::size_t row = 0; row < r.rows(); ++row)
        ends[r.find("position")->values[row]] = r.find("time")->values[row];
      return ends;
    };
    const std::map<double, double> ends = ends_of(finer_);
    std::vector<double> between;
    for (const auto& [position, end] : ends_of(coarser_))
      if (const auto at = ends.find(position); at != ends.end())
        between.push_back(at->second - end);
    std::set<double> all;
    if (between.empty()) return all;
    all.insert(0.0);
    for (int row = -rows_; row <= rows_; ++row)
      all.insert(stats::upper_median(between) + interval_ * row);
    return all;
  }

  static bool rests_at(const Recording& r, std::size_t row) {
    const Channel* phase = r.find("phase");
    return phase == nullptr || phase->values[row] == 0.0;
  }

  std::vector<Meeting> meetings(double shift) const {
    const auto &t = finer_.find("time")->values, &later = coarser_.find("time")->values;
    const auto &p = finer_.find("position")->values, &q = coarser_.find("position")->values;
    const double room = same_time * interval_;
    std::vector<Meeting> all;
    for (std::size_t i = 0, j = 0; j < later.size() && all.size() < enough_meetings; ++j) {
      while (i < t.size() && t[i] < later[j] + shift - room) ++i;
      if (i == t.size()) break;
      if (t[i] <= later[j] + shift + room && p[i] == q[j] && rests_at(finer_, i) &&
          rests_at(coarser_, j))
        all.push_back({i, j});
    }
    return all;
  }

  /// Whether the meetings from three before to the next one follow each other evenly in one rest.
  bool evenly(const std::vector<Meeting>& all, std::size_t k) const {
    const auto& t = finer_.find("time")->values;
    const auto step = [&](std::size_t i) { return t[all[i].finer] - t[all[i - 1].finer]; };
    const auto [least, most] = std::minmax({step(k + 1), step(k), step(k - 1), step(k - 2)});
    return most - least <= 2.0 * same_time * interval_;
  }

  /// What a channel has at every meeting.
  static std::vector<double> taken(const std::vector<double>& x, const std::vector<Meeting>& all,
                                   std::size_t Meeting::*row, Taken how) {
    std::vector<double> values;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const std::size_t last = all[k].*row;
      const bool alone = how == Taken::as_read || k == 0;
      const std::size_t first = alone ? last : all[k - 1].*row + 1;
      double sum = 0.0;
      for (std::size_t i = first; i <= last; ++i) sum += x[i];
      values.push_back(sum / static_cast<double>(last + 1 - first));
    }
    return values;
  }

  Agreement agreement(const HeardTriple& triple, const std::vector<Meeting>& all, Taken how) const {
    const auto& p = finer_.find("position")->values;
    std::vector<signed char> u, v;
    for (const Heard& c : triple) {
      const std::vector<double> x = taken(*c.finer, all, &Meeting::finer, how),
                                y = taken(*c.coarser, all, &Meeting::coarser, how);
      // The mean at the first meeting of a rest would reach into the one before.
      const std::size_t behind = how == Taken::as_means ? 4 : 3;
      for (std::size_t k = behind; k + 1 < all.size(); ++k) {
        const bool rest = p[all[k - behind].finer] == p[all[k + 1].finer] && evenly(all, k);
        u.push_back(rest ? side(x, k, c.least) : no_side);
        v.push_back(rest ? side(y, k, c.least) : no_side);
      }
    }
    return agreement_of(u, v);
  }

  std::optional<SharedNoise> with_shift(double shift, double least_chance) const {
    const std::vector<Meeting> all = meetings(shift);
    SharedNoise found;
    bool no_chance = false;
    for (const HeardTriple& triple : triples_) {
      const std::array both{agreement(triple, all, Taken::as_read),
                            agreement(triple, all, Taken::as_means)};
      const Agreement& best = *std::ranges::max_element(both, {}, &Agreement::excess);
      if (best.signs < few_signs) continue;
      if (best.excess < least_excess) return std::nullopt;
      const double chance = 0.5 * std::erfc(best.sigmas / std::sqrt(2.0));
      no_chance = no_chance || chance < least_chance;
      found.alike += 0.5 * (1.0 + best.excess) * static_cast<double>(best.signs);
      found.readings += best.signs;
    }
    if (!no_chance) return std::nullopt;
    found.alike /= static_cast<double>(found.readings);
    return found;
  }

  const Recording &finer_, &coarser_;
  double interval_;  // of the finer one [s]
  int rows_;         // of the finer one in one of the coarser
  std::vector<HeardTriple> triples_;
};

}  // namespace

std::optional<SharedNoise> shared_noise(const Recording& a, const Recording& b) {
  for (const Recording* r : {&a, &b})
    if (r->rows() == 0 || !r->find("time") || !r->find("position")) return std::nullopt;
  const double of_a = sample_intervals(a).typical, of_b = sample_intervals(b).typical;
  if (!(of_a > 0.0 && of_b > 0.0)) return std::nullopt;
  return of_b < of_a ? Listening(b, a, of_b, of_a).find() : Listening(a, b, of_a, of_b).find();
}

}  // namespace drift
