#include "core/recording/instants/clock_leap.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/linalg.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/rows/row_spacing.hpp"

namespace drift {
namespace {

constexpr double around = 900.0;         // [s] to either side
constexpr std::size_t most_rows = 1000;  // to either side
constexpr std::size_t fewest_rows_beside_leap = 6;
constexpr double sidereal_day = 86164.1;  // [s]
constexpr double straight = 1200.0;       // [s] over which a course is nearly its tangent: 5 deg
constexpr double far = 40.0;              // of chi-square: odds of e^20
constexpr double few_rows = 10.0;         // rows of unequal lengths show such leaps, and lost rows
constexpr double late_row = 0.02;         // part of a row by which its instant may be off

/// Of a course: its value, slope, bend and third power in the middle of the gap, and the step
/// there.
using Numbers = Eigen::Vector<double, 5>;
using Normal = Eigen::Matrix<double, 5, 5>;

/// Rows around one behind a gap.
struct Around {
  std::size_t first = 0, gap = 0, end = 0;
};

Around rows_around(const Recording& r, const std::vector<double>& time, std::size_t row) {
  const auto held = [&](std::size_t a, std::size_t b) {
    for (const auto& [name, room] : {std::pair{"position", 0.0},
                                     {"phase", 0.0},
                                     {"case_heading", same_heading},
                                     {"cmd_x", same_command},
                                     {"cmd_y", same_command},
                                     {"cmd_z", same_command}})
      if (const Channel* c = r.find(name); c && std::abs(c->values[a] - c->values[b]) > room)
        return false;
    return true;
  };
  Around out{row, row, row};
  if (!held(row - 1, row)) return out;
  while (out.first > 0 && row - out.first < most_rows && held(out.first - 1, row) &&
         time[row - 1] - time[out.first - 1] < around)
    --out.first;
  while (out.end < r.rows() && out.end - row < most_rows && held(out.end, row) &&
         time[out.end] - time[row] < around)
    ++out.end;
  return out;
}

/// By how much a channel steps at the gap, in sigma, after a leap and after missing rows.
struct Step {
  double leap = 0.0, gap = 0.0;
};

/// usual: of the rows [s]; missing: how long they would be missing, as far as it is told of [s].
std::optional<Step> step_of(const std::vector<double>& values, const std::vector<double>& time,
                            const Around& rows, double usual, double missing, bool angle) {
  const double removed = time[rows.gap] - time[rows.gap - 1] - usual;
  const double middle = time[rows.gap - 1] + 0.5 * usual;
  Normal N = Normal::Zero();
  Numbers b = Numbers::Zero();
  double squares = 0.0, base = nan_value;
  std::size_t before = 0, behind = 0;
  for (std::size_t row = rows.first; row < rows.end; ++row) {
    if (!std::isfinite(values[row])) continue;
    if (std::isnan(base)) base = values[row];
    double y = values[row] - base;
    if (angle) y = std::remainder(y, 360.0 * detail::deg);
    const bool after = row >= rows.gap;
    ++(after ? behind : before);
    const double x = (time[row] - (after ? removed : 0.0) - middle) / around;
    const Numbers a(1.0, x, x * x, x * x * x, after ? 1.0 : 0.0);
    N += a * a.transpose();
    b += a * y;
    squares += y * y;
  }
  if (before < fewest_rows_beside_leap || behind < fewest_rows_beside_leap) return std::nullopt;
  const Eigen::LDLT<Normal> solver(N);
  const Numbers course = solver.solve(b);
  const double dof = static_cast<double>(before + behind) - 5.0;
  const double variance = std::max(0.0, squares - course.dot(b)) / dof;
  const double rate = course[1] / around;
  const double late = std::pow(late_row * rate * usual, 2);
  // Where nothing moves the rate is its noise, which does not tell one from the other.
  Numbers as_missing = Numbers::Unit(4);
  as_missing[1] = -missing / around;
  const auto sigmas = [&](const Numbers& of) {
    return of.dot(course) / std::sqrt(variance * of.dot(solver.solve(of)) + late);
  };
  const Step step{sigmas(Numbers::Unit(4)), sigmas(as_missing)};
  if (!std::isfinite(step.leap) || !std::isfinite(step.gap)) return std::nullopt;
  return step;
}

}  // namespace

std::vector<ClockLeap> clock_leaps(const Recording& r, const RowSpacing& spacing) {
  std::vector<ClockLeap> all;
  const Channel* time = r.find("time");
  if (time == nullptr || r.rows() < 2 * fewest_rows_beside_leap) return all;
  std::size_t gaps = 0;
  for (std::size_t row = 1; row < r.rows(); ++row) {
    if (!spacing.gap(row)) continue;
    ++gaps;
    const Around rows = rows_around(r, time->values, row);
    if (rows.end == rows.first) continue;
    const double seconds = spacing.step[row] - spacing.usual[row];
    const double missing = std::clamp(std::remainder(seconds, sidereal_day), -straight, straight);
    double leap = 0.0, gap = 0.0, channels = 0.0;
    for (const auto* triple : {&accelerometer_channels, &gimbal_channels})
      for (const auto name : triple->names) {
        const Channel* c = r.find(name);
        const auto step =
            c ? step_of(c->values, time->values, rows, spacing.usual[row], missing, is_angle(name))
              : std::nullopt;
        if (!step) continue;
        leap += step->leap * step->leap;
        gap += step->gap * step->gap;
        channels += 1.0;
      }
    // Wilson-Hilferty: 4.75 sigma, one of 10^6.
    const double part = 2.0 / (9.0 * std::max(1.0, channels));
    const double most = channels * std::pow(1.0 - part + 4.75 * std::sqrt(part), 3);
    if (channels > 0.0 && leap < most && gap > leap + far) all.push_back({row, seconds});
  }
  if (gaps > all.size())
    std::erase_if(all, [&](const ClockLeap& leap) {
      return leap.seconds < few_rows * spacing.usual[leap.row];
    });
  return all;
}

std::string clock_leaps_text(const Recording& r) {
  return r.rows() < 2 * fewest_rows_beside_leap || r.find("time") == nullptr
             ? ""
             : clock_leaps_text(r, clock_leaps(r, row_spacing(r)));
}

std::string clock_leaps_text(const Recording& r, const std::vector<ClockLeap>& all) {
  if (all.empty()) return "";
  const auto line = [&](std::size_t row) { return row < r.lines.size() ? r.lines[row] : row + 1; };
  const ClockLeap& first = all.front();
  return fmt::format(
      "the clock leapt by {:.6g} s between lines {} and {}{}: across that the platform moved as in "
      "one row, no rows are missing. Subtract {:.6g} s from every time from line {} on{}",
      first.seconds, line(first.row - 1), line(first.row),
      all.size() == 1   ? ""
      : all.size() == 2 ? ", and once more behind"
                        : fmt::format(", and {} times more behind", all.size() - 1),
      first.seconds, line(first.row), all.size() == 1 ? "" : ", and so on behind");
}

}  // namespace drift
