#include "core/estimate/strapdown/dwells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/stats/median.hpp"

namespace drift::strapdown {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double outlying = 3.0;              // times the usual spread is not rest
constexpr double slowest_turn = detail::deg;  // [rad/s]; drift of any gyro worth a test is below

struct Spread {
  std::vector<double> gyro, acc;  // of the window around each sample; infinite where there is none
};

struct Moments {
  Vec3 sum = Vec3::Zero(), squares = Vec3::Zero();
  void add(const Vec3& v) {
    sum += v;
    squares += v.cwiseAbs2();
  }
  Vec3 variance(double n) const {
    const Vec3 mean = sum / n;
    return (squares / n - mean.cwiseAbs2()).cwiseMax(0.0);
  }
};

bool continues(const Signals& s, std::size_t k) {
  return s.time[k] - s.time[k - 1] < longest_step * s.interval;
}

Spread spreads(const Signals& s, std::size_t half) {
  const std::size_t n = s.size();
  Spread spread{std::vector<double>(n, never), std::vector<double>(n, never)};
  for (std::size_t k = half; k + half < n; ++k) {
    Moments gyro, acc;
    bool whole = true;
    for (std::size_t i = k - half; i <= k + half && whole; ++i) {
      whole = s.measured(i) && (i == k - half || continues(s, i));
      // Differences from the middle sample: the mean must not cost digits of the variance.
      gyro.add(s.gyro[i] - s.gyro[k]);
      acc.add(s.acc[i] - s.acc[k]);
    }
    if (!whole) continue;
    const double count = static_cast<double>(2 * half + 1);
    spread.gyro[k] = std::sqrt(gyro.variance(count).sum());
    spread.acc[k] = std::sqrt(acc.variance(count).sum());
  }
  return spread;
}

struct Split {
  double floor = 0.0, threshold = 0.0;
};

Split split(const std::vector<double>& spread) {
  std::vector<double> logs;
  for (const double s : spread)
    if (std::isfinite(s)) logs.push_back(std::log(std::max(s, 1e-12)));
  if (logs.empty()) return {};
  std::sort(logs.begin(), logs.end());
  const double total = [&] {
    double sum = 0.0;
    for (const double v : logs) sum += v;
    return sum;
  }();
  const double n = static_cast<double>(logs.size());
  double below = 0.0, best = -1.0, cut = logs.back();
  for (std::size_t k = 1; k < logs.size(); ++k) {
    below += logs[k - 1];
    const double share = static_cast<double>(k) / n;
    const double gap =
        below / static_cast<double>(k) - (total - below) / (n - static_cast<double>(k));
    const double between = share * (1.0 - share) * gap * gap;
    if (between > best) {
      best = between;
      cut = 0.5 * (logs[k - 1] + logs[k]);
    }
  }
  const double floor = std::exp(logs[logs.size() / 4]);
  return {floor, std::max(std::exp(cut), outlying * floor)};
}

Dwell summary(const Signals& s, std::size_t first, std::size_t last) {
  Dwell dwell{.first = first, .last = last, .start = s.time[first], .end = s.time[last]};
  const double n = static_cast<double>(last - first + 1);
  for (std::size_t k = first; k <= last; ++k) {
    dwell.gyro += s.gyro[k] / n;
    dwell.acc += s.acc[k] / n;
  }
  for (std::size_t k = first; k <= last; ++k) {
    dwell.gyro_noise += (s.gyro[k] - dwell.gyro).cwiseAbs2() / n;
    dwell.acc_noise += (s.acc[k] - dwell.acc).cwiseAbs2() / n;
  }
  dwell.gyro_noise = dwell.gyro_noise.cwiseSqrt();
  dwell.acc_noise = dwell.acc_noise.cwiseSqrt();
  return dwell;
}

struct Run {
  std::size_t first = 0, last = 0;
};

/// The longest run of samples from..to that `accepts`; empty (first > last) if there is none.
Run longest_run(std::size_t from, std::size_t to, auto&& accepts) {
  Run best{1, 0};
  for (std::size_t k = from; k <= to; ++k) {
    if (!accepts(k)) continue;
    const std::size_t first = k;
    while (k < to && accepts(k + 1)) ++k;
    if (best.first > best.last || k - first > best.last - best.first) best = {first, k};
  }
  return best;
}

/// The part of a dwell without slips: what stays below three times the dwell's own spread.
Run core_of(const Spread& spread, std::size_t first, std::size_t last) {
  const auto limit = [&](const std::vector<double>& s) {
    const auto at = s.begin();
    return outlying * stats::upper_median({at + static_cast<std::ptrdiff_t>(first),
                                           at + static_cast<std::ptrdiff_t>(last) + 1});
  };
  const double gyro = limit(spread.gyro), acc = limit(spread.acc);
  return longest_run(first, last,
                     [&](std::size_t k) { return spread.gyro[k] <= gyro && spread.acc[k] <= acc; });
}

/// Takes out stretches that turn steadily, about the vertical for instance: quiet, but not at rest.
/// `slow` [rad/s] is what the rates of dwells may differ by.
void drop_steady_turns(std::vector<Dwell>& dwells, double slow) {
  Vec3 usual = Vec3::Zero();
  for (int i = 0; i < 3 && !dwells.empty(); ++i) {
    std::vector<double> rates;
    for (const Dwell& d : dwells) rates.push_back(d.gyro[i]);
    usual[i] = stats::upper_median(std::move(rates));
  }
  std::erase_if(dwells, [&](const Dwell& d) { return !((d.gyro - usual).norm() <= slow); });
}

}  // namespace

DwellSearch find_dwells(const Signals& signals, const DwellOptions& options) {
  // Of 10 rows a second half a window is two and a half: not for the last digit of the clock to
  // say.
  constexpr double below_a_tie = 1.0 - 1e-5;
  const auto half = static_cast<std::size_t>(
      std::max(1.0, std::round(below_a_tie * 0.5 * options.window / signals.interval)));
  const Spread spread = spreads(signals, half);
  const Split gyro = split(spread.gyro), acc = split(spread.acc);
  DwellSearch found{{}, gyro.floor, acc.floor, gyro.threshold, acc.threshold, 0.0};
  const auto quiet = [&](std::size_t k) {
    return spread.gyro[k] < gyro.threshold && spread.acc[k] < acc.threshold;
  };
  for (std::size_t k = 0; k < signals.size(); ++k) {
    if (!quiet(k)) continue;
    const std::size_t first = k;
    while (k + 1 < signals.size() && quiet(k + 1)) ++k;
    const Run core = core_of(spread, first, k);
    if (core.first > core.last) continue;
    const double quiet_for = signals.time[core.last] - signals.time[core.first];
    if (core.last - core.first < 2 * half + 2 || quiet_for < options.static_min) {
      found.longest_left = std::max(found.longest_left, quiet_for);
      continue;
    }
    found.dwells.push_back(summary(signals, core.first + half, core.last - half));
    found.dwells.back().quiet = quiet_for;
  }
  drop_steady_turns(found.dwells, std::max(gyro.threshold, slowest_turn));
  return found;
}

}  // namespace drift::strapdown
