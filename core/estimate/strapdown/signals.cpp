#include "core/estimate/strapdown/signals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/check.hpp"
#include "core/base/nan.hpp"
#include "core/recording/sample_kind.hpp"
#include "core/stats/median.hpp"

namespace drift::strapdown {
namespace {

constexpr std::array<const char*, 7> names{"time",  "gyro_x", "gyro_y", "gyro_z",
                                           "acc_x", "acc_y",  "acc_z"};

bool fits(std::size_t column, const Unit& unit) {
  if (column == 0) return unit.same_dimension(unit::s);
  if (column <= 3) return unit.same_dimension(unit::deg_per_s);
  // The reader turns m/s^2 into g and may keep the unit of the file beside the values.
  return unit.same_dimension(unit::g) || unit.same_dimension("m/s^2"_unit);
}

std::array<const Channel*, 7> find_channels(const Recording& recording) {
  constexpr std::array<const char*, 3> expected{"s", "rad/s", "g"};
  std::array<const Channel*, 7> found{};
  std::vector<std::string> problems;
  for (std::size_t c = 0; c < names.size(); ++c) {
    const char* unit = expected[c == 0 ? 0 : (c <= 3 ? 1 : 2)];
    found[c] = recording.find(names[c]);
    if (found[c] == nullptr)
      problems.push_back(
          fmt::format("{}: no channel '{}' (a strapdown recording has '{} [{}]'). Add the column",
                      recording.source, names[c], names[c], unit));
    else if (!fits(c, found[c]->unit))
      problems.push_back(
          fmt::format("{}: channel '{}' is in '{}' (a unit like '{}' is expected). "
                      "Correct the header",
                      recording.source, names[c], found[c]->unit.symbol.view(), unit));
  }
  if (!problems.empty()) throw InputError(ExitCode::recording, std::move(problems));
  return found;
}

void check_time(const Recording& recording, const std::vector<double>& time) {
  if (time.size() < 2)
    throw InputError(ExitCode::recording, fmt::format("{}: {} samples (two or more are expected). "
                                                      "Give a longer recording",
                                                      recording.source, time.size()));
  for (std::size_t k = 1; k < time.size(); ++k)
    if (!(time[k] > time[k - 1])) {
      const std::size_t line = k < recording.lines.size() ? recording.lines[k] : k + 1;
      throw InputError(
          ExitCode::recording,
          fmt::format("{}:{}:1: time {} s after {} s (it must increase). Remove or sort "
                      "the sample",
                      recording.source, line, time[k], time[k - 1]));
    }
}

/// A lone empty cell of one sensor axis, where a whole row that is lost would be bridged: on the
/// cubic through two neighbours on either side, or the line where they are not all there at equal
/// distances.
void bridge_lone_cells(const std::vector<double>& time, double interval,
                       std::vector<Vec3>& sensor) {
  const std::vector<Vec3> given = sensor;
  for (std::size_t k = 1; k + 1 < time.size(); ++k) {
    const double across = time[k + 1] - time[k - 1];
    if (given[k].allFinite() || !(across < longest_step * interval)) continue;
    const double part = (time[k] - time[k - 1]) / across;
    const bool even = k >= 2 && k + 2 < time.size() &&
                      std::abs(time[k + 2] - time[k - 2] - 4.0 * interval) < 0.5 * interval;
    for (int a = 0; a < 3; ++a) {
      if (std::isfinite(given[k][a])) continue;
      sensor[k][a] = given[k - 1][a] + part * (given[k + 1][a] - given[k - 1][a]);
      const double outer = even ? given[k - 2][a] + given[k + 2][a] : nan_value;
      if (std::isfinite(outer))
        sensor[k][a] = (4.0 * (given[k - 1][a] + given[k + 1][a]) - outer) / 6.0;
    }
  }
}

/// A second divided difference of three samples, and how far the third is from the other two.
struct Bend {
  Vec3 of = Vec3::Zero();  ///< both in lengths of the interval between samples k - 1 and k
  double away = 0.0;
};

/// How samples bend from k - 1 to k to their neighbour before or after. Nothing where none was
/// measured, where rows lack in between, or where it is so near that its noise would be blown up.
std::optional<Bend> bend(const Signals& s, const std::vector<Vec3>& sensor, std::size_t k,
                         bool before) {
  if (before ? k < 2 : k + 1 == s.size()) return std::nullopt;
  const std::size_t outer = before ? k - 2 : k + 1, inner = before ? k - 1 : k;
  const double dt = s.time[k] - s.time[k - 1], step = std::abs(s.time[outer] - s.time[inner]);
  if (!sensor[outer].allFinite() || step > longest_step * s.interval || dt > longest_step * step)
    return std::nullopt;
  const double away = step / dt;
  const Vec3 inside = sensor[before ? k : k - 1] - sensor[inner],
             outside = (sensor[inner] - sensor[outer]) / away;
  return Bend{(inside - outside) / (1.0 + away), away};
}

/// Mean of the cubic through instants k - 2 to k + 1 from k - 1 to k; of the parabola or the line
/// through those that there are.
Vec3 mean_of_instants(const Signals& s, const std::vector<Vec3>& sensor, std::size_t k) {
  const Vec3 line = 0.5 * (sensor[k - 1] + sensor[k]);
  const auto before = bend(s, sensor, k, true), after = bend(s, sensor, k, false);
  if (!before && !after) return line;
  if (!before || !after) return line - (before ? before->of : after->of) / 6.0;
  const double p = before->away, q = after->away;
  return line -
         ((1.0 + 2.0 * q) * before->of + (1.0 + 2.0 * p) * after->of) / (12.0 * (1.0 + p + q));
}

}  // namespace

double Signals::covered(std::size_t k) const {
  if (k == 0) return interval;
  const double step = time[k] - time[k - 1];
  return std::min(step, sampled_over(step, interval));
}

Vec3 mean_between(const Signals& s, const std::vector<Vec3>& sensor, std::size_t k) {
  if (!s.means) return mean_of_instants(s, sensor, k);
  const double part = s.covered(k) / (s.time[k] - s.time[k - 1]);
  return part * sensor[k] + 0.5 * (1.0 - part) * (sensor[k - 1] + sensor[k]);
}

Signals signals_of(const Recording& recording) {
  const auto column = find_channels(recording);
  Signals signals;
  signals.means = holds_mean_rates(recording);
  signals.time = column[0]->values;
  check_time(recording, signals.time);
  const std::size_t n = signals.time.size();
  signals.gyro.reserve(n);
  signals.acc.reserve(n);
  for (std::size_t k = 0; k < n; ++k) {
    signals.gyro.emplace_back(column[1]->values[k], column[2]->values[k], column[3]->values[k]);
    signals.acc.emplace_back(column[4]->values[k], column[5]->values[k], column[6]->values[k]);
  }
  std::vector<double> steps(n - 1);
  for (std::size_t k = 1; k < n; ++k) steps[k - 1] = signals.time[k] - signals.time[k - 1];
  signals.interval = stats::upper_median(std::move(steps));
  bridge_lone_cells(signals.time, signals.interval, signals.gyro);
  bridge_lone_cells(signals.time, signals.interval, signals.acc);
  return signals;
}

}  // namespace drift::strapdown
