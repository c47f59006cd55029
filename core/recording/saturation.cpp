#include "core/recording/saturation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/nan.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/rows/reading_step.hpp"
#include "core/stats/median.hpp"
#include "core/stats/proportion.hpp"

namespace drift {
namespace {

constexpr double near = 10.0;  ///< [sigma] noise brings no reading that far from what is measured

bool is_gyro(std::string_view channel) {
  return std::ranges::find(gyro_channels.names, channel) != gyro_channels.names.end();
}

/// Of the quietest quarter of all windows, 1 sigma; 0 where no window is whole. apart: readings
/// that do not count.
double quiet_noise(const std::vector<double>& x, const Channel* position,
                   const std::vector<bool>& apart) {
  constexpr std::size_t window = 16;
  constexpr double of_white = 20.0;  // square of third_difference()
  std::vector<double> squares;
  for (std::size_t first = 0; first + window <= x.size(); first += window) {
    if (position && position->values[first] != position->values[first + window - 1]) continue;
    double sum = 0.0;
    bool whole = true;
    for (std::size_t k = first; k < first + window && whole; ++k) {
      whole = std::isfinite(x[k]) && !apart[k];
      if (whole && k >= first + 3) sum += third_difference(x, k) * third_difference(x, k);
    }
    if (whole) squares.push_back(sum / (of_white * static_cast<double>(window - 3)));
  }
  if (squares.empty()) return 0.0;
  const auto quarter = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 4);
  std::ranges::nth_element(squares, quarter);
  return std::sqrt(*quarter);
}

class SeenValues {
 public:
  SeenValues(const Recording& recording, const Channel& channel)
      : channel_(channel), x_(channel.values), extreme_(x_.size(), false) {
    for (const double v : x_)
      if (std::isfinite(v)) {
        low_ = all_ == 0 ? v : std::min(low_, v);
        high_ = all_ == 0 ? v : std::max(high_, v);
        ++all_;
      }
    if (all_ == 0) return;
    for (std::size_t k = 0; k < x_.size(); ++k) extreme_[k] = x_[k] == low_ || x_[k] == high_;
    sigma_ = quiet_noise(x_, recording.find("position"), extreme_);
    // An end of the range need not be a whole number of steps from anything else.
    Channel inner = channel;
    for (std::size_t k = 0; k < x_.size(); ++k)
      if (extreme_[k]) inner.values[k] = nan_value;
    const double step = shown_step(recording, inner);
    const double least = std::sqrt(std::max(0.0, sigma_ * sigma_ - 0.25 * step * step));
    repeats_ =
        std::max(repeated_part(), least > 0.0 ? std::erf(step / (std::sqrt(8.0) * least)) : 1.0);
    if (!is_gyro(channel.name)) return;
    std::vector<double> measured = x_;
    std::erase_if(measured, [](double v) { return !std::isfinite(v); });
    middle_ = stats::median(std::move(measured));
  }

  std::vector<Saturation> found(std::size_t sensors) const {
    std::vector<Saturation> out;
    if (all_ == 0 || !(repeats_ < 1.0) || !(low_ < high_)) return out;
    const double chance = saturated_by_chance / static_cast<double>(sensors);
    for (const auto at : {Saturation::At::low, Saturation::At::high})
      if (const auto one = at_end(at, 0.5 * chance)) out.push_back(*one);
    if (is_gyro(channel_.name)) add_runs(out, chance);
    return out;
  }

 private:
  /// Part of the values, read once or in a run, that are read in a run; by the rule of succession.
  double repeated_part() const {
    double runs = 2.0, longer = 1.0;
    for (std::size_t k = 0; k < x_.size();) {
      std::size_t end = k + 1;
      while (end < x_.size() && x_[end] == x_[k]) ++end;
      if (std::isfinite(x_[k]) && !extreme_[k]) {
        runs += 1.0;
        longer += end > k + 1 ? 1.0 : 0.0;
      }
      k = end;
    }
    return longer / runs;
  }

  bool turns(double reading) const {
    return !is_gyro(channel_.name) || std::abs(reading - middle_) > near * sigma_;
  }

  std::optional<Saturation> at_end(Saturation::At at, double chance) const {
    const double end = at == Saturation::At::low ? low_ : high_;
    if (!turns(end)) return std::nullopt;
    Saturation s{channel_.name, end, at, {}};
    std::size_t next_to_it = 0;
    for (std::size_t k = 0; k < x_.size(); ++k) {
      if (x_[k] == end)
        s.rows.push_back(k);
      else if (std::abs(x_[k] - end) <= near * sigma_)
        ++next_to_it;
    }
    if (s.rows.size() < 2) return std::nullopt;
    const std::size_t again = s.rows.size() - 1;
    if (stats::binomial_tail(again, again + next_to_it, repeats_) > chance) return std::nullopt;
    return s;
  }

  /// One of rows first to end; an end of the range has all of its rows.
  void add_run(std::vector<Saturation>& out, std::size_t first, std::size_t end) const {
    using enum Saturation::At;
    const double value = x_[first];
    auto s = std::ranges::find(out, value, &Saturation::value);
    if (s != out.end() && s->rows.back() >= first) return;
    if (s == out.end())
      s = out.insert(s, {channel_.name,
                         value,
                         value == low_    ? low
                         : value == high_ ? high
                                          : between,
                         {}});
    for (std::size_t k = first; k < end; ++k) s->rows.push_back(k);
  }

  /// Runs that chance does not make so long.
  void add_runs(std::vector<Saturation>& out, double chance) const {
    const auto turning = static_cast<double>(
        std::ranges::count_if(x_, [&](double v) { return std::isfinite(v) && turns(v); }));
    for (std::size_t k = 0; k < x_.size();) {
      std::size_t end = k + 1;
      while (end < x_.size() && x_[end] == x_[k]) ++end;
      const auto again = static_cast<double>(end - k - 1);
      if (std::isfinite(x_[k]) && again > 0.0 && turns(x_[k]) &&
          turning * std::pow(repeats_, again) <= chance)
        add_run(out, k, end);
      k = end;
    }
  }

  const Channel& channel_;
  const std::vector<double>& x_;
  std::vector<bool> extreme_;
  std::size_t all_ = 0;
  double low_ = 0.0, high_ = 0.0, sigma_ = 0.0, middle_ = 0.0;
  double repeats_ = 1.0;  ///< chance that a reading is one that was named, at most
};

}  // namespace

std::size_t Saturation::runs() const {
  std::size_t n = rows.empty() ? 0 : 1;
  for (std::size_t k = 1; k < rows.size(); ++k) n += rows[k] != rows[k - 1] + 1 ? 1 : 0;
  return n;
}

std::vector<Saturation> saturations(const Recording& recording, const Channel& channel,
                                    std::size_t sensors) {
  return SeenValues(recording, channel).found(sensors);
}

std::vector<Saturation> saturated_gyros(const Recording& recording) {
  std::vector<Saturation> all;
  for (const std::string_view name : gyro_channels.names)
    if (const Channel* gyro = recording.find(name))
      for (Saturation& s : saturations(recording, *gyro, gyro_channels.names.size()))
        all.push_back(std::move(s));
  return all;
}

}  // namespace drift
