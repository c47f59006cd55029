#include "analysis/preparation/command_change.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "analysis/preparation/input_thresholds.hpp"
#include "core/plan/slew_check.hpp"
#include "core/recording/recording_channels.hpp"

namespace drift::preparation {
namespace {

std::optional<Mat3> shown_attitude(const Recording& r, const Site& site, std::size_t row) {
  const auto angles = measured(r, gimbal_channels, row);
  if (!angles) return std::nullopt;
  return attitude_shown(r, site, row, *angles);
}

}  // namespace

CommandChange command_change(const Recording& recording, const Site& site, std::size_t row,
                             const RowSpacing& spacing) {
  const auto before = measured(recording, command_channels, row - 1),
             after = measured(recording, command_channels, row);
  const auto from = shown_attitude(recording, site, row - 1),
             to = shown_attitude(recording, site, row);
  if (!before || !after || !from || !to)
    return {0.0, "no gimbal angles tell when the command changed"};
  const auto& time = recording.find("time")->values;
  const double t0 = time[row - 1], t1 = time[row];
  const Mat3 turned = from->transpose() * *to;
  const auto misfit = [&](double t) {
    const Mat3 commanded =
        rotation<double>(*before * (t - t0)) * rotation<double>(*after * (t1 - t));
    return rotation_vector(Mat3(commanded.transpose() * turned)).norm();
  };
  CommandChange best{t0, "", misfit(t0)};
  double least = std::numeric_limits<double>::infinity();
  const double finest = std::min(spacing.usual[row - 1], spacing.usual[row]);
  const auto consider = [&](double t) {
    if (!(t > t0 - 1e-6 * finest && t < t1 - 1e-6 * finest)) return;
    if (const double m = misfit(t); m < least) {
      least = m;
      best.time = std::max(t, t0);
    }
  };
  const auto steps = [&](double usual) {
    return std::min(RecordingLimits::longest_gap,
                    static_cast<std::size_t>(std::lround((t1 - t0) / usual)));
  };
  for (std::size_t k = 0; k <= steps(spacing.usual[row - 1]); ++k)
    consider(t0 + static_cast<double>(k) * spacing.usual[row - 1]);
  for (std::size_t k = 1; k <= steps(spacing.usual[row]); ++k)
    consider(t1 - static_cast<double>(k) * spacing.usual[row]);
  if (!(least <= RecordingLimits::change_room * finest * (*after - *before).norm()))
    return {0.0, "no time at which a row would have stood explains how far the platform turned",
            best.as_recorded};
  if (best.time - t0 < 1e-6 * finest) best.time = t0;
  return best;
}

}  // namespace drift::preparation
