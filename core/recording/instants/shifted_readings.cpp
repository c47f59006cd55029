#include "core/recording/instants/shifted_readings.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/linalg.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/rows/row_spacing.hpp"
#include "core/stats/median.hpp"

namespace drift {
namespace {

constexpr int most_degrees = 4;
constexpr std::size_t rows_per_degree = 8;
constexpr std::size_t fewest = 4;  // readings of a stretch
constexpr int passes = 3;          // readings far off are left out, and others come to be far off
/// Times the median deviation: 6.7 sigma of a normal one, 2e-11 of the readings of a right log.
constexpr double far_off = 10.0;

using Coefficients = Eigen::Matrix<double, most_degrees + 1, 1>;
using Normal = Eigen::Matrix<double, most_degrees + 1, most_degrees + 1>;

/// Legendre's polynomials at x, those beyond the degree zero.
Coefficients basis(double x, int degree) {
  Coefficients p = Coefficients::Zero();
  p[0] = 1.0;
  if (degree > 0) p[1] = x;
  for (int k = 1; k < degree; ++k) p[k + 1] = ((2 * k + 1) * x * p[k] - k * p[k - 1]) / (k + 1);
  return p;
}

/// Rows that one smooth course goes through.
struct EvenRows {
  std::size_t first = 0, end = 0;
};

std::vector<EvenRows> stretches_of(const Recording& r) {
  const std::vector<double>& time = r.find("time")->values;
  std::vector<std::pair<const Channel*, double>> held;  // what breaks it, by more than that
  for (const auto& [name, room] : {std::pair{"position", 0.0},
                                   {"phase", 0.0},
                                   {"case_heading", same_heading},
                                   {"cmd_x", same_command},
                                   {"cmd_y", same_command},
                                   {"cmd_z", same_command}})
    if (const Channel* c = r.find(name)) held.emplace_back(c, room);
  std::vector<EvenRows> all;
  const auto add = [&](std::size_t first, std::size_t end) {
    const double length = time[end - 1] - time[first];
    const auto parts = static_cast<std::size_t>(std::max(1.0, std::ceil(length / longest_stretch)));
    for (std::size_t k = 0; k < parts; ++k)  // a long one in parts of as many rows
      all.push_back({first + (end - first) * k / parts, first + (end - first) * (k + 1) / parts});
  };
  std::size_t first = 0;
  for (std::size_t row = 1; row <= r.rows(); ++row) {
    const bool on = row < r.rows() && std::ranges::all_of(held, [&](const auto& h) {
                      return std::abs(h.first->values[row] - h.first->values[row - 1]) <= h.second;
                    });
    if (on) continue;
    add(first, row);
    first = row;
  }
  return all;
}

/// The course of a channel along a stretch, in its middle and half its length.
class Course {
 public:
  /// Empty (`any` false) where too little was read.
  Course(const std::vector<double>& time, const std::vector<double>& values, const EvenRows& s)
      : middle_(0.5 * (time[s.first] + time[s.end - 1])),
        half_(std::max(0.5 * (time[s.end - 1] - time[s.first]), 1e-9)) {
    std::vector<std::size_t> rows;
    for (std::size_t row = s.first; row < s.end; ++row)
      if (std::isfinite(values[row])) rows.push_back(row);
    if (rows.size() < fewest) return;
    any_ = true;
    for (int pass = 0; pass < passes; ++pass) {
      fit(time, values, rows);
      std::vector<double> off;
      for (const std::size_t row : rows) off.push_back(std::abs(values[row] - at(time[row])));
      const double most = far_off * stats::median(off);
      const std::size_t before = rows.size();
      std::erase_if(rows, [&](std::size_t row) {
        return most > 0.0 && std::abs(values[row] - at(time[row])) > most;
      });
      if (rows.size() == before || rows.size() < fewest) break;
    }
  }
  bool any() const { return any_; }
  int numbers() const { return degree_ + 1; }
  double at(double t) const { return basis((t - middle_) / half_, degree_).dot(coefficients_); }

 private:
  void fit(const std::vector<double>& time, const std::vector<double>& values,
           const std::vector<std::size_t>& rows) {
    degree_ = std::clamp(static_cast<int>(rows.size() / rows_per_degree), 1, most_degrees);
    Normal N = Normal::Identity();
    N.topLeftCorner(degree_ + 1, degree_ + 1).setZero();
    Coefficients b = Coefficients::Zero();
    for (const std::size_t row : rows) {
      const Coefficients p = basis((time[row] - middle_) / half_, degree_);
      N.topLeftCorner(degree_ + 1, degree_ + 1) +=
          p.head(degree_ + 1) * p.head(degree_ + 1).transpose();
      b += p * values[row];
    }
    coefficients_ = N.ldlt().solve(b);
  }

  double middle_, half_;
  int degree_ = 0;
  Coefficients coefficients_ = Coefficients::Zero();
  bool any_ = false;
};

/// Angles without whole turns between two rows of a stretch; other readings as they are.
std::vector<double> unwrapped(const Channel& c, const std::vector<EvenRows>& stretches) {
  constexpr double turn = 360.0 * detail::deg;
  std::vector<double> values = c.values;
  if (!c.name.starts_with("gimbal_")) return values;
  for (const EvenRows& s : stretches) {
    double before = nan_value;
    for (std::size_t row = s.first; row < s.end; ++row) {
      if (!std::isfinite(values[row])) continue;
      if (std::isfinite(before)) values[row] = before + std::remainder(values[row] - before, turn);
      before = values[row];
    }
  }
  return values;
}

}  // namespace

void shift_readings(Recording& recording, std::span<const std::string_view> channels,
                    double seconds) {
  if (seconds == 0.0 || recording.find("time") == nullptr) return;
  const std::vector<double> time = recording.find("time")->values;
  const std::vector<EvenRows> stretches = stretches_of(recording);
  for (Channel& c : recording.channels) {
    if (std::ranges::find(channels, c.name) == channels.end()) continue;
    const std::vector<double> values = unwrapped(c, stretches);
    for (const EvenRows& s : stretches) {
      if (s.end - s.first < fewest) continue;
      const Course course(time, values, s);
      if (!course.any()) continue;
      for (std::size_t row = s.first; row < s.end; ++row)
        c.values[row] += course.at(time[row] + seconds) - course.at(time[row]);
    }
  }
}

double scatter_about_course(const Recording& recording,
                            std::span<const std::string_view> channels) {
  const std::vector<double>& time = recording.find("time")->values;
  const std::vector<EvenRows> stretches = stretches_of(recording);
  std::vector<double> off;
  for (const std::string_view name : channels) {
    const Channel* c = recording.find(name);
    const std::vector<double>& weights =
        name.starts_with("gimbal_") ? recording.readings : recording.samples;
    if (c == nullptr) continue;
    const std::vector<double> values = unwrapped(*c, stretches);
    for (const EvenRows& s : stretches) {
      if (s.end - s.first < fewest) continue;
      const Course course(time, values, s);
      if (!course.any()) continue;
      const auto n = static_cast<double>(s.end - s.first);
      const double taken_up = std::sqrt(n / (n - course.numbers()));
      for (std::size_t row = s.first; row < s.end; ++row) {
        const double worth = weights.empty() ? 1.0 : weights[row];
        if (std::isfinite(values[row]))
          off.push_back(std::abs(values[row] - course.at(time[row])) * taken_up * std::sqrt(worth));
      }
    }
  }
  const double most = far_off * stats::median(off);
  double squares = 0.0, count = 0.0;
  for (const double x : off)
    if (x <= most) {
      squares += x * x;
      count += 1.0;
    }
  return count > 0.0 ? std::sqrt(squares / count) : nan_value;
}

void take_instants(Recording& recording, const RecordingFormat& format) {
  double earlier = -format.accelerometers_late.value_or(0.0);
  if (format.accelerometers == AccelerometerReading::momentary) {
    std::vector<double> usual = row_spacing(recording).usual;
    std::erase_if(usual, [](double x) { return !std::isfinite(x); });
    if (!usual.empty()) earlier += 0.5 * stats::median(std::move(usual));
  }
  shift_readings(recording, accelerometer_channels.names, -earlier);
  shift_readings(recording, gimbal_channels.names, format.gimbals_late.value_or(0.0));
}

}  // namespace drift
