#include "core/recording/rows/even_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/base/number_text.hpp"

namespace drift {
namespace {

constexpr double same_distance = 1e-4;    // part of a distance by which equal ones differ
constexpr double least_share = 0.1;       // of all distances that are of either kind
constexpr double lost_share = 1.0 / 3.0;  // below: rows may be lost where one is twice the other
constexpr double fewest_shared = 3.0;     // distances of no length

/// Rows first..last of one position.
struct EvenPart {
  std::size_t first = 0, last = 0;
  double rows() const { return static_cast<double>(last - first + 1); }
};

std::vector<EvenPart> positions_of(const Recording& r) {
  const Channel *position = r.find("position"), *phase = r.find("phase");
  const auto same_in = [](const Channel* c, std::size_t a, std::size_t b) {
    return c == nullptr || c->values[a] == c->values[b];
  };
  std::vector<EvenPart> all;
  for (std::size_t k = 0; k < r.rows(); ++k)
    if (k > 0 && same_in(position, k - 1, k) && same_in(phase, k - 1, k))
      all.back().last = k;
    else
      all.push_back({k, k});
  return all;
}

/// Whether two rows are one that was written twice: no sensor reads anything else.
bool same_readings(const Recording& r, std::size_t a, std::size_t b) {
  bool any = false;
  for (const Channel& c : r.channels) {
    if (!c.name.starts_with("acc_") && !c.name.starts_with("gimbal_")) continue;
    any = true;
    if (c.values[a] != c.values[b]) return false;
  }
  return any;
}

/// In which steps times are written, and how many of those the shorter distances are.
struct WrittenSteps {
  double step = 0.0, whole = 0.0;
};

/// The step in which times are written, if all distances are of two kinds, one step apart; empty if
/// they are not. The shorter ones may be none at all: two rows in a minute, and times in minutes.
std::optional<WrittenSteps> steps_of(const Recording& r, const std::vector<double>& time,
                                     const std::vector<EvenPart>& parts) {
  double low = HUGE_VAL, high = 0.0;
  for (const EvenPart& s : parts)
    for (std::size_t k = s.first + 1; k <= s.last; ++k) {
      const double d = time[k] - time[k - 1];
      if (!(d >= 0.0) || (d == 0.0 && same_readings(r, k - 1, k))) return std::nullopt;
      low = std::min(low, d);
      high = std::max(high, d);
    }
  const double step = high - low;
  if (!(step > same_distance * high)) return std::nullopt;
  const double whole = std::round(low / step);
  if ((low > 0.0 && whole < 1.0) || std::abs(low - whole * step) > same_distance * high)
    return std::nullopt;
  double lows = 0.0, highs = 0.0;
  for (const EvenPart& s : parts)
    for (std::size_t k = s.first + 1; k <= s.last; ++k) {
      const double d = time[k] - time[k - 1];
      const bool is_low = std::abs(d - low) < same_distance * high;
      if (!is_low && !(std::abs(d - high) < same_distance * high)) return std::nullopt;
      (is_low ? lows : highs) += 1.0;
    }
  const double share = highs / (lows + highs);
  if (share < (whole == 1.0 ? lost_share : least_share) || share > 1.0 - least_share)
    return std::nullopt;
  // A few times that stand twice are a mistake, and no step.
  if (whole < 1.0 && (lows < fewest_shared || share > 1.0 - lost_share)) return std::nullopt;
  return WrittenSteps{step, whole};
}

/// Distances of rows [s] that would be written as they are.
struct Spacings {
  double least = 0.0, most = HUGE_VAL;
  bool any() const { return least <= most; }
  void also(const Spacings& other) {
    least = std::max(least, other.least);
    most = std::min(most, other.most);
  }
};

/// What is left of the times of a part without rows at such a distance, from the least to the most.
double spread_at(double spacing, const std::vector<double>& time, const EvenPart& s) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (std::size_t k = s.first; k <= s.last; ++k) {
    const double off = time[k] - spacing * static_cast<double>(k - s.first);
    low = std::min(low, off);
    high = std::max(high, off);
  }
  return high - low;
}

/// Whether times are rounded or cut, what even rows leave is spread over less than a step. The
/// spread is convex in the distance: its least by thirds, both ends by halves.
Spacings spacings_of(const std::vector<double>& time, const EvenPart& s, double step) {
  if (s.rows() < 2.0) return {};
  constexpr int rounds = 100;
  const double usual = (time[s.last] - time[s.first]) / (s.rows() - 1.0),
               reach = step / (s.rows() - 1.0);
  double low = usual - reach, high = usual + reach;
  for (int k = 0; k < rounds; ++k) {
    const double third = (high - low) / 3.0;
    const bool left = spread_at(low + third, time, s) < spread_at(high - third, time, s);
    (left ? high : low) += left ? -third : third;
  }
  const double best = 0.5 * (low + high), widest = step * (1.0 - same_distance);
  if (spread_at(best, time, s) > widest) return {best, -HUGE_VAL};
  const auto end = [&](double outside) {
    double inside = best;
    for (int k = 0; k < rounds; ++k) {
      const double middle = 0.5 * (inside + outside);
      (spread_at(middle, time, s) > widest ? outside : inside) = middle;
    }
    return inside;
  };
  return {end(usual - 2.0 * reach), end(usual + 2.0 * reach)};
}

/// The roundest of them: a multiple of as large a 1, 2 or 5 times a power of ten as there is, the
/// one nearest to the middle. Loggers are set to such: to whole seconds, where they write minutes,
/// so that nothing finer than a sixtieth of a step is a distance. A row that is lost makes one.
std::optional<double> roundest(const Spacings& all, double step) {
  const double middle = 0.5 * (all.least + all.most), finest = step / 60.0;
  for (double power = std::pow(10.0, std::ceil(std::log10(all.most)));
       power >= finest * (1.0 - same_distance); power *= 0.1)
    for (const double unit : {power, 0.5 * power, 0.2 * power}) {
      const double multiple = unit * std::round(middle / unit);
      if (unit >= finest * (1.0 - same_distance) && multiple > 0.0 && multiple >= all.least &&
          multiple <= all.most)
        return multiple;
    }
  return std::nullopt;
}

}  // namespace

void take_even_times(Recording& r) {
  const auto channel = std::ranges::find(r.channels, "time", &Channel::name);
  if (channel == r.channels.end() || !r.begins.empty()) return;
  std::vector<double>& time = channel->values;
  std::vector<EvenPart> parts = positions_of(r);
  const auto written = steps_of(r, time, parts);
  if (!written) return;
  const double step = written->step;
  // The clock of a log goes on from position to position, unless rows are left out between them.
  const EvenPart whole{0, r.rows() - 1};
  Spacings spacings = spacings_of(time, whole, step);
  if (spacings.any()) {
    parts = {whole};
  } else {
    spacings = {};
    for (const EvenPart& s : parts) spacings.also(spacings_of(time, s, step));
    if (!spacings.any()) return;
  }
  const auto round = roundest(spacings, step);
  if (!round) return;
  const double spacing = *round;
  std::vector<double> even(time.size());
  for (const EvenPart& s : parts) {
    double off = 0.0;
    for (std::size_t k = s.first; k <= s.last; ++k)
      off += (time[k] - spacing * static_cast<double>(k - s.first)) / s.rows();
    for (std::size_t k = s.first; k <= s.last; ++k) {
      even[k] = off + spacing * static_cast<double>(k - s.first);
      if (std::abs(even[k] - time[k]) > step || (k > 0 && !(even[k] > even[k - 1]))) return;
    }
  }
  time = std::move(even);
  r.remarks.add(
      Weight::doubtful,
      fmt::format("times are written in steps of {} s: the rows are taken as evenly spaced "
                  "within each position, {} s apart ({} to {} s would be written alike). "
                  "Log finer times",
                  number_text(step), number_text(spacing, 6), number_text(spacings.least, 6),
                  number_text(spacings.most, 6)));
}

}  // namespace drift
