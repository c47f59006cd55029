#include "analysis/preparation/clock_unit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "analysis/preparation/input_thresholds.hpp"
#include "analysis/preparation/noise_card.hpp"
#include "core/physics/earth.hpp"
#include "core/plan/slew_check.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/stats/median.hpp"

namespace drift::preparation {
namespace {

/// Whether the command is zero in these rows; true where there is none.
bool uncommanded(const Recording& r, const RestingRows& rest) {
  for (const char* name : {"cmd_x", "cmd_y", "cmd_z"})
    if (const Channel* c = r.find(name))
      for (std::size_t k = rest.first; k <= rest.last; ++k)
        if (!(std::abs(c->values[k]) < ClockLimits::no_command)) return false;
  return true;
}

/// How fast the platform turns in a rest by the recording's clock, as the gimbals show it, and how
/// fast Up turns against it, as the accelerometers do [rad/s].
struct Rates {
  double gimbals = 0.0, accelerometers = 0.0;
};

/// Whether half of a turn is made from one row to the next: then rows are of another position
/// (labels that come late), or one was read wrongly, whatever the clock says.
bool jumps(const Recording& r, std::size_t first, std::size_t last, double turn) {
  constexpr std::size_t fewest = 4;  // steps: of fewer even ones each is as large
  if (last < first + fewest) return false;
  for (std::size_t k = first + 1; k <= last; ++k) {
    const auto from = measured(r, gimbal_channels, k - 1), to = measured(r, gimbal_channels, k);
    if (from && to &&
        rotation_vector(Mat3(local_attitude_shown(r, k, *to) *
                             local_attitude_shown(r, k - 1, *from).transpose()))
                .norm() > 0.5 * turn)
      return true;
  }
  return false;
}

/// Whether the platform is turned in one half of the rows and stands in the other (rows on the way
/// under the number of the next position): the Earth and drift turn it as fast in both.
bool turned_in_a_half(const Recording& r, std::size_t first, std::size_t last) {
  const auto& time = r.find("time")->values;
  const std::size_t middle = (first + last) / 2;
  const auto rate = [&](std::size_t from, std::size_t to) -> std::optional<double> {
    const auto a = measured(r, gimbal_channels, from), b = measured(r, gimbal_channels, to);
    if (!a || !b || !(time[to] > time[from])) return std::nullopt;
    const Mat3 turn =
        local_attitude_shown(r, to, *b) * local_attitude_shown(r, from, *a).transpose();
    return rotation_vector(turn).norm() / (time[to] - time[from]);
  };
  const auto before = rate(first, middle), behind = rate(middle, last);
  return before && behind &&
         std::max(*before, *behind) > ClockLimits::steady * std::min(*before, *behind);
}

/// The first and the last row left out, which may be of the neighbours; empty where one of the two
/// instruments does not show it.
std::optional<Rates> rates_in(const Recording& r, RestingRows rest) {
  if (rest.last < rest.first + 3) return std::nullopt;
  ++rest.first, --rest.last;
  const auto& time = r.find("time")->values;
  std::size_t last = rest.last;
  while (last > rest.first + 1 && time[last] - time[rest.first] > PlanLimits::longest_turn) --last;
  const double seconds = time[last] - time[rest.first];
  const auto g0 = measured(r, gimbal_channels, rest.first), g1 = measured(r, gimbal_channels, last),
             f0 = measured(r, accelerometer_channels, rest.first),
             f1 = measured(r, accelerometer_channels, last);
  if (!g0 || !g1 || !f0 || !f1 || !(seconds > 0.0)) return std::nullopt;
  const Mat3 turn =
      local_attitude_shown(r, last, *g1) * local_attitude_shown(r, rest.first, *g0).transpose();
  const double angle = rotation_vector(turn).norm();
  if (jumps(r, rest.first, last, angle) || turned_in_a_half(r, rest.first, last))
    return std::nullopt;
  return Rates{angle / seconds, std::atan2(f0->cross(*f1).norm(), f0->dot(*f1)) / seconds};
}

/// The units that are a factor apart: what the times say, and what they are if they are so many
/// times too short.
struct Factor {
  double times;
  std::string_view said, meant;
};
constexpr Factor factors[] = {{60.0, "s", "min"}, {1000.0, "ms", "s"},
                              {3600.0, "s", "h"}, {1.0 / 60.0, "min", "s"},
                              {1e-3, "s", "ms"},  {1.0 / 3600.0, "h", "s"}};

}  // namespace

std::string other_unit_of_time(const Recording& r) {
  if (r.find("time") == nullptr) return "";
  std::vector<double> gimbals, accelerometers;
  for (const RestingRows& rest : resting_rows(r))
    if (const auto rates = uncommanded(r, rest) ? rates_in(r, rest) : std::nullopt) {
      gimbals.push_back(rates->gimbals);
      accelerometers.push_back(rates->accelerometers);
    }
  if (gimbals.empty()) return "";
  const double rate = stats::upper_median(std::move(gimbals)), ratio = rate / detail::earth_rate;
  // Angles in another unit turn as wrongly: Up, which turns at a part of the rate, is no angle.
  const double of_up = stats::upper_median(std::move(accelerometers)) / detail::earth_rate;
  const bool fast = ratio > ClockLimits::nothing_like && of_up > ClockLimits::up_turns;
  const bool slow = ratio < 1.0 / ClockLimits::nothing_like &&
                    of_up < 1.0 / ClockLimits::nothing_like && r.find("cmd_x") != nullptr;
  if (!fast && !slow) return "";
  const auto* unit = std::ranges::find_if(factors, [&](const Factor& f) {
    return std::abs(std::log(ratio / f.times)) < std::log(ClockLimits::alike);
  });
  if (slow && unit == std::end(factors)) return "";  // it may be held
  return fmt::format(
      "{}: by its times the platform, which nothing commands, turns at {:.3g} deg/h (expected "
      "about "
      "{:.0f} deg/h, as the Earth does).{} Give the column of times its unit, in the header or in "
      "[recording] columns",
      r.source.empty() ? "recording" : r.source, rate / unit::deg_per_h.to_si,
      detail::earth_rate / unit::deg_per_h.to_si,
      unit == std::end(factors)
          ? ""
          : fmt::format(" Are they in {} where {} is said?", unit->meant, unit->said));
}

}  // namespace drift::preparation
