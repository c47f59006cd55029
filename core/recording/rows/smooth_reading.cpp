#include "core/recording/rows/smooth_reading.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "core/base/linalg.hpp"
#include "core/recording/rows/parabola.hpp"
#include "core/recording/rows/reading_step.hpp"
#include "core/stats/median.hpp"

namespace drift {
namespace {

constexpr std::size_t most_points = 2000;   ///< of a longer log a few readings make one point
constexpr std::size_t fewest_readings = 4;  ///< of a parabola that leaves anything
constexpr std::size_t beside = 2;           ///< readings to each side that tell the scatter
constexpr double narrowest = 2.5;           ///< half a width [points]: two to each side
constexpr double wider = 1.2;               ///< from one width to the next

/// The readings of a column, without the rows that have none.
struct Readings {
  Channel column, position;
  std::vector<double> times;
  bool has_positions = false;

  const Channel* positions() const { return has_positions ? &position : nullptr; }
  std::size_t size() const { return times.size(); }
};

Readings readings_of(const Recording& r, const Channel& c) {
  const Channel *time = r.find("time"), *position = r.find("position");
  Readings out{{c.name, c.unit, {}}, {"position", unit::one, {}}, {}, position != nullptr};
  for (std::size_t row = 0; row < c.values.size(); ++row) {
    if (!std::isfinite(c.values[row])) continue;
    out.column.values.push_back(c.values[row]);
    out.times.push_back(time->values[row]);
    if (position) out.position.values.push_back(position->values[row]);
  }
  return out;
}

/// Whether a reading is anywhere off the straight line through the two before it.
bool bends_anywhere(const std::vector<double>& x, double step) {
  for (std::size_t i = 2; i < x.size(); ++i)
    if (std::abs(x[i] - 2.0 * x[i - 1] + x[i - 2]) > 0.5 * step) return true;
  return false;
}

/// Of every reading, how many in a row are that value.
std::vector<double> runs_of(const std::vector<double>& x) {
  std::vector<double> runs(x.size());
  for (std::size_t first = 0, end = 0; first < x.size(); first = end) {
    while (end < x.size() && x[end] == x[first]) ++end;
    std::fill(runs.begin() + static_cast<std::ptrdiff_t>(first),
              runs.begin() + static_cast<std::ptrdiff_t>(end), static_cast<double>(end - first));
  }
  return runs;
}

/// The variance of the readings about the parabola through those beside them: the usual one, so
/// that what jumps here or there has no part in it.
double scatter_of(const Readings& r, std::size_t stride) {
  constexpr int points = 2 * static_cast<int>(beside) + 1;
  constexpr double median_of_chi_square = 1.3862943611198906;  // of two degrees of freedom: 2 ln 2
  std::vector<double> squares;
  for (std::size_t at = beside; at + beside < r.size(); at += stride) {
    Eigen::Matrix<double, points, 3> powers;
    Eigen::Matrix<double, points, 1> read;
    const double length = r.times[at + beside] - r.times[at - beside];
    for (int k = 0; k < points; ++k) {
      const std::size_t row = at - beside + static_cast<std::size_t>(k);
      const double s = (r.times[row] - r.times[at]) / length;
      powers.row(k) << 1.0, s, s * s;
      read[k] = r.column.values[row] - r.column.values[at];
    }
    const Vec3 parabola = powers.householderQr().solve(read);
    squares.push_back((read - powers * parabola).squaredNorm());
  }
  return squares.empty() ? 0.0 : stats::median(std::move(squares)) / median_of_chi_square;
}

}  // namespace

std::optional<SmoothReading> SmoothReading::of(const Recording& recording,
                                               std::string_view column) {
  const Channel* c = recording.find(column);
  if (c == nullptr || recording.find("time") == nullptr) return std::nullopt;
  const Readings r = readings_of(recording, *c);
  const auto step = reading_step(r.column, r.positions());
  const std::vector<double>& x = r.column.values;
  if (!step || !bends_anywhere(x, *step)) return std::nullopt;

  SmoothReading out;
  out.step_ = *step;
  const std::size_t together = 1 + (r.size() - 1) / most_points;
  const auto count = static_cast<double>(together);
  std::vector<std::size_t> looked_at;  // the middle reading of each point
  std::vector<double> apart;
  for (std::size_t first = 0; first + together <= r.size(); first += together) {
    double time = 0.0, value = 0.0;
    for (std::size_t k = first; k < first + together; ++k) {
      time += r.times[k] / count;
      value += x[k] / count;
    }
    if (!out.times_.empty()) apart.push_back(time - out.times_.back());
    out.times_.push_back(time);
    out.values_.push_back(value);
    looked_at.push_back(first + together / 2);
  }
  if (apart.empty()) return std::nullopt;

  const std::vector<double> runs = runs_of(x);
  const double variance = std::max(*step * *step / 12.0, scatter_of(r, together));
  const auto points = static_cast<double>(looked_at.size());
  double least = 2.0 * variance;  // as read
  const double span = r.times.back() - r.times.front();
  for (double half = narrowest * stats::median(apart); half < 2.0 * span; half *= wider) {
    double left = 0.0, parts = 0.0;
    for (const std::size_t k : looked_at) {
      const auto there = parabola_at(out.times_, out.values_, r.times[k], half, fewest_readings);
      if (there) left += (x[k] - there->value) * (x[k] - there->value);
      parts += there ? std::min(1.0, there->part * runs[k] / count) : 1.0;
    }
    if (const double error = (left + 2.0 * variance * parts) / points; error < least) {
      least = error;
      out.half_ = half;
    }
    if (left > least * points) break;
  }
  if (out.half_ == 0.0) return std::nullopt;
  // That is best at one instant. Over all parabolas side by side their noise averages out and their
  // bias, a third of it, does not: so much narrower is the bias as small a part of what is left
  // then, as it goes over the noise with the width to the power of 4 1/2.
  const double side_by_side = std::max(1.0, span / (2.0 * out.half_));
  out.half_ = std::max(narrowest * stats::median(apart),
                       out.half_ * std::pow(side_by_side, -1.0 / (2.0 * 4.5)));
  return out;
}

std::optional<double> SmoothReading::at(double t) const {
  const auto there = parabola_at(times_, values_, t, half_, fewest_readings);
  if (!there) return std::nullopt;
  return there->value;
}

}  // namespace drift
