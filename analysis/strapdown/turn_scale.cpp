#include "analysis/strapdown/turn_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "analysis/inference/thresholds.hpp"
#include "analysis/preparation/input_thresholds.hpp"
#include "analysis/strapdown/rate_about_up.hpp"
#include "core/base/check.hpp"
#include "core/base/words.hpp"

namespace drift::strapdown {
namespace {

using Limits = preparation::GyroUnitLimits;
using inference::FitLimits;

/// Gravity at the end of a way, as the gyros carry it and as it is seen.
struct Way {
  Vec3 carried, seen;  ///< unit vectors
  Mat3 by_log_scale;   ///< d carried by d log of what the rates of gyro x, y, z are taken times
  double turn = 0.0;   ///< of gravity [rad]

  double error() const { return std::atan2(carried.cross(seen).norm(), carried.dot(seen)) / turn; }
};

/// The ways whose turn is known, the rates taken times `taken`. What the gyros read at rest goes
/// over from that of the dwell before to that of the dwell after: the Earth's rate is part of it.
std::vector<Way> ways_of(const Signals& s, const std::vector<Dwell>& dwells, const Vec3& taken) {
  std::vector<Way> all;
  for (std::size_t d = 1; d < dwells.size(); ++d) {
    const Dwell &from = dwells[d - 1], &to = dwells[d];
    const Vec3 before = from.acc.normalized();
    Way way{before, to.acc.normalized(), Mat3::Zero()};
    way.turn = std::atan2(before.cross(way.seen).norm(), before.dot(way.seen));
    if (way.turn < Limits::least_turn) continue;
    Mat3 R = Mat3::Identity(), by_scale = Mat3::Zero();
    for (std::size_t k = from.last + 1; k <= to.first; ++k) {
      const double part =
          static_cast<double>(k - from.last) / static_cast<double>(to.first - from.last);
      const Vec3 rate = mean_between(s, s.gyro, k) - from.gyro - part * (to.gyro - from.gyro),
                 step = (s.time[k] - s.time[k - 1]) * taken.cwiseProduct(rate);
      const Mat3 one = rotation(step);
      R = R * one;
      by_scale = one.transpose() * by_scale;
      by_scale += step.asDiagonal();
    }
    if (!R.allFinite()) continue;  // a sample is missing
    way.carried = R.transpose() * before;
    way.by_log_scale = skew(way.carried) * by_scale;
    all.push_back(way);
  }
  return all;
}

/// The rates that make the gyros turn as gravity does, by least squares.
struct Fit {
  Vec3 taken = Vec3::Ones();
  MatX covariance;  ///< of the logs of what is free
  double squares = 0.0, variance = 0.0;
  std::vector<Way> ways;
};

double squares_of(const std::vector<Way>& ways) {
  double sum = 0.0;
  for (const Way& way : ways) sum += (way.seen - way.carried).squaredNorm();
  return sum;
}

/// free: columns of what logs of the three rates follow; start: of what is free.
std::optional<Fit> fit_of(const Signals& s, const std::vector<Dwell>& dwells, const MatX& free,
                          const VecX& start) {
  constexpr int rounds = 8;
  VecX x = start;
  Fit out;
  MatX normal;
  for (int round = 0; round <= rounds; ++round) {
    out.taken = Vec3(free * x).array().exp();
    out.ways = ways_of(s, dwells, out.taken);
    normal = MatX::Zero(free.cols(), free.cols());
    VecX right = VecX::Zero(free.cols());
    for (const Way& way : out.ways) {
      const MatX J = way.by_log_scale * free;
      normal += J.transpose() * J;
      right += J.transpose() * (way.seen - way.carried);
    }
    if (round == rounds) break;
    const VecX step = normal.ldlt().solve(right);
    if (!step.allFinite()) return std::nullopt;
    x += step;
    if (step.norm() < 1e-9) break;
  }
  out.squares = squares_of(out.ways);
  const double freedom = 2.0 * static_cast<double>(out.ways.size()) -
                         static_cast<double>(free.cols());  // a direction has two
  if (!(freedom > 0.0)) return std::nullopt;
  out.variance = out.squares / freedom;
  out.covariance = out.variance * normal.inverse();
  if (!out.covariance.allFinite() || !out.taken.allFinite()) return std::nullopt;
  return out;
}

MatX all_alike() {
  return MatX::Ones(3, 1);
}

/// Of one factor from an eighth to eight: a start every root of two, for a turn is none of itself
/// from a certain error on.
std::optional<Fit> far_fit(const Signals& s, const std::vector<Dwell>& dwells, const MatX& free) {
  constexpr int steps = 6;
  double least = 0.0;
  VecX start = VecX::Zero(1);
  for (int k = -steps; k <= steps; ++k) {
    const double log_scale = 0.5 * k * std::log(2.0);
    const double squares = squares_of(ways_of(s, dwells, Vec3(free * log_scale).array().exp()));
    if (k > -steps && squares >= least) continue;
    least = squares;
    start[0] = log_scale;
  }
  return fit_of(s, dwells, free, start);
}

bool beyond(double factor, double sigma, double prior) {
  return std::abs(factor - 1.0) > FitLimits::beyond_prior * std::hypot(prior, factor * sigma);
}

/// What the gyros at rest read of the Earth about Up, over what it is; 1 sigma.
struct EarthAboutUp {
  double part = 0.0, sigma = 0.0;
};

std::optional<EarthAboutUp> earth_about_up(const std::vector<Dwell>& dwells, const Site& site) {
  const double there = site.omega_ie_l()[2];
  if (there == 0.0) return std::nullopt;
  std::vector<Vec3> up, gyro;
  for (const Dwell& dwell : dwells) {
    up.push_back(dwell.acc.normalized());
    gyro.push_back(dwell.gyro);
  }
  const auto read = rate_about_up(up, gyro);
  if (!read) return std::nullopt;
  return EarthAboutUp{read->rate / there, read->sigma / std::abs(there)};
}

/// The column that is wrong, and what of it.
struct Mend {
  std::string channel;
  std::string words;
};

/// Whether the scale of all gyros is off by `factor`, or the times are, as far as the Earth tells.
Mend scale_or_times(double factor, const std::optional<EarthAboutUp>& earth) {
  constexpr double told = 3.0;  // [sigma] that it is not the other
  const auto off = [&](double expected) {
    return std::abs(earth->part - expected) / std::hypot(earth->sigma, 1e-3);
  };
  if (earth && off(factor) < told && off(1.0) > told)
    return {"gyro_x", "their scale: at rest they read the Earth's rate as many times, too"};
  if (earth && off(1.0) < told && off(factor) > told)
    return {"time",
            fmt::format("the times, which are all {:.3g} times as long as they were: at rest the "
                        "gyros read the Earth's rate as it is",
                        factor)};
  return {"gyro_x", "their scale, or the times (the clock, the sample interval)"};
}

}  // namespace

void require_turn_scale(const Signals& signals, const std::vector<Dwell>& dwells, const Site& site,
                        const std::string& source, double prior) {
  const auto is_off = [](const Way& way) { return way.error() > Limits::alike; };
  const std::vector<Way> declared = ways_of(signals, dwells, Vec3::Ones());
  const auto wrong = static_cast<std::size_t>(std::ranges::count_if(declared, is_off));
  if (wrong < Limits::fewest_turns) return;
  const auto refuse = [&](const std::string& who, double factor, const Mend& mend) {
    throw InputError(
        ExitCode::recording,
        fmt::format("{}:{}: {} {:.3g} times what gravity shows from rest to rest: in {} of {} "
                    "turns the error is above {:.0f} %, and in none after this. Correct {}",
                    source, mend.channel, who, factor, wrong, declared.size(),
                    100.0 * Limits::alike, mend.words));
  };
  const auto explains = [&](const std::optional<Fit>& fit) {
    return fit && std::ranges::none_of(fit->ways, is_off);
  };
  const auto all = far_fit(signals, dwells, all_alike());
  if (explains(all)) {
    const double factor = 1.0 / all->taken[0];
    if (beyond(factor, std::sqrt(all->covariance(0, 0)), prior))
      refuse("the gyros turn", factor, scale_or_times(factor, earth_about_up(dwells, site)));
    return;
  }
  std::optional<std::pair<int, Fit>> one;
  for (int axis = 0; axis < 3; ++axis) {
    auto fit = far_fit(signals, dwells, Vec3::Unit(axis));
    if (!explains(fit)) continue;
    if (one) return;  // two gyros would do
    one.emplace(axis, std::move(*fit));
  }
  if (!one) return;
  const auto& [axis, fit] = *one;
  const double factor = 1.0 / fit.taken[axis];
  if (beyond(factor, std::sqrt(fit.covariance(0, 0)), prior))
    refuse(fmt::format("gyro {} turns", "xyz"[axis]), factor,
           {fmt::format("gyro_{}", "xyz"[axis]), "its scale, or its unit in the header"});
}

std::string turn_scale_remark(const Signals& signals, const std::vector<Dwell>& dwells,
                              const Vec3& priors) {
  const auto each = fit_of(signals, dwells, MatX::Identity(3, 3), VecX::Zero(3));
  if (!each || each->ways.size() < Limits::fewest_turns) return "";
  // What the three have in common, each its own scale beside it as far as the priors know that.
  const Vec3 logs = -each->taken.array().log();
  const Mat3 weight = (Mat3(each->covariance) + Mat3(priors.cwiseAbs2().asDiagonal())).inverse();
  const double sigma_common = 1.0 / std::sqrt(weight.sum());
  const double common = (weight * logs).sum() / weight.sum();
  const Vec3 unlike = logs - Vec3::Constant(common);
  const double alike = -2.0 * std::log(inference::SearchLimits::alpha);  // of 2 degrees of freedom
  if (unlike.dot(weight * unlike) < alike)
    return std::abs(std::exp(common) - 1.0) > FitLimits::beyond_prior * sigma_common
               ? fmt::format(
                     "from rest to rest the gyros turn {:.5g} times what gravity shows, "
                     "all three alike: their scale, or the times (the clock, the sample "
                     "interval)",
                     std::exp(common))
               : "";
  std::vector<std::string> off;
  for (int axis = 0; axis < 3; ++axis) {
    const double factor = 1.0 / each->taken[axis], sigma = std::sqrt(each->covariance(axis, axis));
    if (beyond(factor, sigma, priors[axis]))
      off.push_back(fmt::format("gyro {} turns {:.5g} times", "xyz"[axis], factor));
  }
  return off.empty() ? ""
                     : fmt::format(
                           "from rest to rest {} what gravity shows: the scale is off by "
                           "more than {:.0f} sigmas of its prior",
                           listed(off, "and"), FitLimits::beyond_prior);
}

}  // namespace drift::strapdown
