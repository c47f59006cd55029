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

/// The step in which times are written, if all distances are of two kinds, one step apart; empty if
/// they are not.
std::optional<double> step_of(const std::vector<double>& time, const std::vector<EvenPart>& parts) {
  double low = 0.0, high = 0.0;
  for (const EvenPart& s : parts)
    for (std::size_t k = s.first + 1; k <= s.last; ++k) {
      const double d = time[k] - time[k - 1];
      low = low == 0.0 ? d : std::min(low, d);
      high = std::max(high, d);
    }
  const double step = high - low;
  if (!(low > 0.0) || !(step > same * high)) return std::nullopt;
  const double whole = std::round(low / step);
  if (whole < 1.0 || std::abs(low - whole * step) > same * high) return std::nullopt;
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
  return step;
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

}  // namespace

void take_even_times(Recording& r) {
  const auto channel = std::ranges::find(r.channels, "time", &Channel::name);
  if (channel == r.channels.end() || !r.begins.empty()) return;
  std::vector<double>& time = channel->values;
  const std::vector<EvenPart> parts = positions_of(r);
  const auto step = step_of(time, parts);
  if (!step) return;
  const double spacing = spacing_of(time, parts);
  std::vector<double> even(time.size());
  for (const EvenPart& s : parts) {
    double off = 0.0;
    for (std::size_t k = s.first; k <= s.last; ++k)
      off += (time[k] - spacing * static_cast<double>(k - s.first)) / s.rows();
    for (std::size_t k = s.first; k <= s.last; ++k) {
      even[k] = off + spacing * static_cast<double>(k - s.first);
      if (std::abs(even[k] - time[k]) > *step) return;
    }
  }
  time = std::move(even);
  r.remarks.add(Weight::doubtful,
                fmt::format("times are written in steps of {} s, and the rows are {} s apart: they "
                            "are taken as evenly spaced within each position. Log finer times",
                            number_text(*step), number_text(spacing, 6)));
}

}  // namespace drift
