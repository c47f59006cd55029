#include "analysis/preparation/gimbal_zero.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "analysis/preparation/input_thresholds.hpp"
#include "core/physics/gimbals.hpp"
#include "core/physics/term_library.hpp"
#include "core/recording/recording_channels.hpp"

namespace drift::preparation {
namespace {

using Limits = GimbalZeroLimits;

/// Both instruments over the interval of one row.
struct Seen {
  Vec3 force;                ///< specific force, of length 1, platform axes
  Vec3 before, after;        ///< gimbal angles at its ends [rad]
  std::size_t position = 0;  ///< from 0, in the order of the rows
};

/// The rows of dwells that have the row before them, and the positions they are of.
std::vector<Seen> seen_in(const Recording& r, std::size_t& positions) {
  std::vector<Seen> all;
  const Channel *phase = r.find("phase"), *position = r.find("position");
  double last = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 1; i < r.rows(); ++i) {
    if (position == nullptr || position->values[i] != position->values[i - 1]) continue;
    if (phase != nullptr && (phase->values[i] > 0.5 || phase->values[i - 1] > 0.5)) continue;
    const auto f = measured(r, accelerometer_channels, i), end = measured(r, gimbal_channels, i),
               begin = measured(r, gimbal_channels, i - 1);
    if (!f || !end || !begin || !(f->norm() > 0.0)) continue;
    if (position->values[i] != last) ++positions;
    last = position->values[i];
    all.push_back({f->normalized(), *begin, *end, positions - 1});
  }
  return all;
}

/// Where Up is, platform axes, as the gimbals of a level case show it.
Vec3 up_by(const Vec3& angles) {
  return gimbal_chain(angles).row(2);
}

/// By how much the accelerometers differ from that in a row, `zero` added to the angles.
Vec3 difference(const Seen& s, const Vec3& zero) {
  return s.force - (up_by(s.before + zero) + up_by(s.after + zero)).normalized();
}

double rms(const std::vector<Seen>& all, const Vec3& zero) {
  double sum = 0.0;
  for (const Seen& s : all) sum += difference(s, zero).squaredNorm();
  return std::sqrt(sum / static_cast<double>(all.size()));
}

/// The same of what changes of it within the positions, the mean of each taken off: biases,
/// misalignments and zeros hardly do, but what a gimbal of the wrong sign makes does as it turns.
double rms_within(const std::vector<Seen>& all, std::size_t positions) {
  std::vector<Vec3> sum(positions, Vec3::Zero());
  std::vector<double> rows(positions, 0.0);
  double squares = 0.0;
  for (const Seen& s : all) {
    const Vec3 d = difference(s, Vec3::Zero());
    sum[s.position] += d;
    rows[s.position] += 1.0;
    squares += d.squaredNorm();
  }
  for (std::size_t p = 0; p < positions; ++p) squares -= sum[p].squaredNorm() / rows[p];
  return std::sqrt(std::max(0.0, squares) / static_cast<double>(all.size()));
}

/// The chance that a change of sign of one of three gimbals leaves so small a part of what changes
/// within the positions, if that is of no sign: a slope of Up about two level axes in each of n / 2
/// positions, in no direction sooner than in another. Of all directions in n dimensions less than
/// part^(n - 1) lie so near to a line.
double chance_of_part(double part, std::size_t positions) {
  const double n = 2.0 * static_cast<double>(positions);
  return part < 1.0 ? 3.0 * std::pow(part, n - 1.0) : 1.0;
}

/// What is to be added to one gimbal, by Gauss and Newton; infinite where no row shows it.
double fitted_zero(const std::vector<Seen>& all, int gimbal) {
  constexpr int rounds = 6;
  constexpr double step = 1e-5;  // [rad]
  const Vec3 axis = Vec3::Unit(gimbal);
  double zero = 0.0;
  for (int round = 0; round < rounds; ++round) {
    double squares = 0.0, product = 0.0;
    for (const Seen& s : all) {
      const Vec3 d = difference(s, zero * axis),
                 slope = (difference(s, (zero + step) * axis) - d) / step;
      squares += slope.squaredNorm();
      product -= slope.dot(d);
    }
    if (squares < Limits::shown * static_cast<double>(all.size()))
      return std::numeric_limits<double>::infinity();
    zero += product / squares;
  }
  return zero;
}

/// What biases and misalignments make of Up where the unit is as its priors say [rad].
double expected_difference(const mc::Study& study) {
  double bias = 0.0, turn = 0.0;
  const auto widen = [](double& widest, const Prior& prior) {
    widest = std::max(widest, std::abs(prior.mean()) + prior.sigma());
  };
  for (std::size_t p = 0; p < TermLibrary::num_params; ++p) {
    const std::string_view key = TermLibrary::specs[p].key.view();
    const bool of_bias = key.size() == 4 && key.starts_with("K0_"),
               of_turn = key.size() == 4 && (key.starts_with("dP_") || key.starts_with("dO_"));
    if (!of_bias && !of_turn) continue;
    widen(of_bias ? bias : turn, TermLibrary::specs[p].prior_si());
    for (const FilterSpec& filter : study.filters)
      if (filter.active[p]) widen(of_bias ? bias : turn, filter.priors[p]);
  }
  return std::sqrt(2.0 * (bias * bias + turn * turn));  // two axes lie level
}

std::vector<Seen> reversed(std::vector<Seen> all, int gimbal) {
  for (Seen& s : all) {
    s.before[gimbal] = -s.before[gimbal];
    s.after[gimbal] = -s.after[gimbal];
  }
  return all;
}

}  // namespace

std::string gimbal_of_wrong_sign(const mc::Study& study, const Recording& recording) {
  std::size_t positions = 0;
  const std::vector<Seen> all = seen_in(recording, positions);
  if (positions < Limits::positions) return "";
  const double expected = expected_difference(study), before = rms(all, Vec3::Zero());
  std::array<double, 3> left{};
  for (int g = 0; g < 3; ++g)
    left[static_cast<std::size_t>(g)] = rms(reversed(all, g), Vec3::Zero());
  const auto best = static_cast<std::size_t>(std::ranges::min_element(left) - left.begin());
  const bool alone = std::ranges::count_if(left, [&](double other) {
                       return other < Limits::clearly * left[best];
                     }) == 1;
  if (!alone || left[best] > Limits::left * expected) return "";
  const bool large = before >= Limits::least * expected && before >= Limits::clearly * left[best];
  const double within = rms_within(all, positions),
               within_left = rms_within(reversed(all, static_cast<int>(best)), positions);
  if (!large &&
      !(within > 0.0 && chance_of_part(within_left / within, positions) < Limits::sign_by_chance))
    return "";
  const std::string_view name = gimbal_channels.names[best];
  const std::string right = fmt::format("{} = \"-{}\"", name, name);
  return fmt::format(
      "{}: column {}: the sign is wrong (with {} accelerometers and gimbals show Up within {:.2g} "
      "deg of each other{}, as it is within {:.2g} deg only). Correct the recording, or say so in "
      "the study: [recording] columns = {{ {} }}, with its unit as in the header",
      recording.source.empty() ? "the recording" : recording.source, name, right,
      (large ? left[best] : within_left) / detail::deg,
      large ? "" : ", but for a constant in each position", (large ? before : within) / detail::deg,
      right);
}

std::string gimbal_off_zero(const mc::Study& study, const Recording& recording) {
  std::size_t positions = 0;
  const std::vector<Seen> all = seen_in(recording, positions);
  if (positions < Limits::positions) return "";
  const double expected = expected_difference(study), before = rms(all, Vec3::Zero());
  if (before < expected) return "";
  std::array<double, 3> zeros{}, left{};
  int best = 0;
  for (int g = 0; g < 3; ++g) {
    const auto at = static_cast<std::size_t>(g);
    zeros[at] = fitted_zero(all, g);
    left[at] = std::isfinite(zeros[at]) ? rms(all, zeros[at] * Vec3::Unit(g)) : before;
    if (left[at] < left[static_cast<std::size_t>(best)]) best = g;
  }
  const auto at = static_cast<std::size_t>(best);
  const bool alone = std::ranges::count_if(left, [&](double other) {
                       return other < Limits::clearly * left[at];
                     }) == 1;
  if (!alone || !(std::abs(zeros[at]) > Limits::least * expected) ||
      left[at] > Limits::left * expected)
    return "";
  constexpr std::string_view alike[] = {
      "A case that leans by as much about the axis of the outer gimbal looks the same. ", "",
      "Accelerometers that are turned by as much about the z axis of the platform look the same. "};
  return fmt::format(
      "{}:{}: it reads {:.3g} deg too {}, as the accelerometers show in {} positions: with that "
      "put "
      "right both show Up within {:.2g} deg, as it is read within {:.2g} deg only. {}Correct its "
      "zero, or write offset = {{ {} = \"{:.4g} deg\" }} in [recording]",
      recording.source.empty() ? "the recording" : recording.source, gimbal_channels.names[at],
      std::abs(zeros[at]) / detail::deg, zeros[at] > 0.0 ? "little" : "much", positions,
      left[at] / detail::deg, before / detail::deg, alike[at], gimbal_channels.names[at],
      zeros[at] / detail::deg);
}

}  // namespace drift::preparation
