#include "core/recording/rows/even_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/base/number_text.hpp"

namespace drift {
namespace {

constexpr double same = 1e-4;             // part of a distance by which equal ones differ
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
  if (!(step > same * high)) return std::nullopt;
  const double whole = std::round(low / step);
  if ((low > 0.0 && whole < 1.0) || std::abs(low - whole * step) > same * high) return std::nullopt;
  double lows = 0.0, highs = 0.0;
  for (const EvenPart& s : parts)
    for (std::size_t k = s.first + 1; k <= s.last; ++k) {
      const double d = time[k] - time[k - 1];
      const bool is_low = std::abs(d - low) < same * high;
      if (!is_low && !(std::abs(d - high) < same * high)) return std::nullopt;
      (is_low ? lows : highs) += 1.0;
    }
  const double share = highs / (lows + highs);
  if (share < (whole == 1.0 ? lost_share : least_share) || share > 1.0 - least_share)
    return std::nullopt;
  // A few times that stand twice are a mistake, and no step.
  if (whole < 1.0 && (lows < fewest_shared || share > 1.0 - lost_share)) return std::nullopt;
  return WrittenSteps{step, whole};
}

/// The usual distance of rows that are evenly spaced within every part.
double spacing_of(const std::vector<double>& time, const std::vector<EvenPart>& parts) {
  double product = 0.0, squares = 0.0;  // least squares of time against the number of the row
  for (const EvenPart& s : parts) {
    const double middle = 0.5 * (s.rows() - 1.0);
    for (std::size_t k = s.first; k <= s.last; ++k) {
      const double x = static_cast<double>(k - s.first) - middle;
      product += x * (time[k] - time[s.first]);
      squares += x * x;
    }
  }
  return product / squares;
}

/// Of rows that share a written time: a whole number of them to a step, where that fits what is
/// written as well.
double whole_spacing(double spacing, double step, const std::vector<EvenPart>& parts) {
  const double whole = step / std::round(step / spacing);
  const auto fits = [&](const EvenPart& s) { return std::abs(whole - spacing) * s.rows() < step; };
  return std::ranges::all_of(parts, fits) ? whole : spacing;
}

}  // namespace

void take_even_times(Recording& r) {
  const auto channel = std::ranges::find(r.channels, "time", &Channel::name);
  if (channel == r.channels.end() || !r.begins.empty()) return;
  std::vector<double>& time = channel->values;
  const std::vector<EvenPart> parts = positions_of(r);
  const auto written = steps_of(r, time, parts);
  if (!written) return;
  const double step = written->step, usual = spacing_of(time, parts),
               spacing = written->whole > 0.0 ? usual : whole_spacing(usual, step, parts);
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
  r.remarks.add(Weight::doubtful,
                fmt::format("times are written in steps of {} s, and the rows are {} s apart: they "
                            "are taken as evenly spaced within each position. Log finer times",
                            number_text(step), number_text(spacing, 6)));
}

}  // namespace drift
