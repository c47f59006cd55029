#include "analysis/cli/shell/recorded_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/cli/shell/two_ups.hpp"
#include "analysis/preparation/input_thresholds.hpp"
#include "core/physics/earth.hpp"
#include "core/physics/gimbals.hpp"
#include "core/plan/attitude_slips.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/rows/row_spacing.hpp"
#include "core/stats/median.hpp"

namespace drift::cli {
namespace {

/// A right-handed frame with the axis up (or down) that the accelerometers show. Headings leave no
/// trace in them.
std::string axes_of(const Vec3& force) {
  constexpr std::string_view up[] = {"x=U y=N z=W", "x=W y=U z=N", "x=N y=W z=U"};
  constexpr std::string_view down[] = {"x=D y=W z=N", "x=N y=D z=W", "x=W y=N z=D"};
  int vertical = 0;
  force.cwiseAbs().maxCoeff(&vertical);
  return std::string(force[vertical] < 0.0 ? down[vertical] : up[vertical]);
}

Vec3 mean_force(const Recording& r, std::size_t first, std::size_t end) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t row = first; row < end; ++row)
    if (const auto force = measured(r, accelerometer_channels, row)) sum += *force;
  return sum;
}

/// Whether accelerometers have Up where gimbals have it: else steps of a few degrees are no turns
/// of the platform, but the zero of a gimbal.
bool show_one_up(const Vec3& force, const Vec3& gimbals) {
  constexpr double apart = 2.0 * detail::deg;
  const Vec3 up = gimbal_chain(gimbals).row(2);
  return std::atan2(force.cross(up).norm(), force.dot(up)) < apart;
}

/// What gimbals show of an attitude, R_lp, and by what it may be off [rad].
struct Seen {
  Mat3 R_lp;
  double room = 0.0;
};

/// The attitude at the begin of a row, at the end of which the gimbals are read: the platform
/// turned in it as in the next row, if that is there. Empty without gimbal angles.
std::optional<Seen> seen_at(const Recording& r, std::size_t row, std::size_t end, double length) {
  const auto angles = measured(r, gimbal_channels, row);
  if (!angles) return std::nullopt;
  const Mat3 R = gimbal_chain(*angles);
  const double drift = detail::earth_rate * length;
  const auto next = row + 1 < end ? measured(r, gimbal_channels, row + 1) : std::nullopt;
  if (!next) return Seen{R, drift};
  const auto& time = r.find("time")->values;
  const Vec3 turn = rotation_vector(Mat3(R.transpose() * gimbal_chain(*next))) *
                    (length / (time[row + 1] - time[row]));
  constexpr double twice = 2.0;  // the Earth's rate: more is no drift
  return turn.norm() < twice * drift ? Seen{R * rotation<double>(-turn), 0.0} : Seen{R, drift};
}

/// To six digits, so that whole numbers of samples are whole as they are written, too.
double as_written(double sample) {
  if (!(sample > 0.0) || !std::isfinite(sample)) return sample;
  const double unit = std::pow(10.0, std::floor(std::log10(sample)) - 5.0);
  return unit < 1.0 ? std::round(sample / unit) / std::round(1.0 / unit)
                    : std::round(sample / unit) * unit;
}

/// Rows of one position, and the first of them that is of the dwell.
struct PositionRows {
  std::size_t first = 0, end = 0, dwell = 0;
};

std::vector<PositionRows> rows_by_position(const Recording& r) {
  const Channel *position = r.find("position"), *phase = r.find("phase");
  std::vector<PositionRows> all;
  for (std::size_t first = 0, end = 0; first < r.rows(); first = end) {
    end = first + 1;
    while (end < r.rows() && (!position || position->values[end] == position->values[first])) ++end;
    std::size_t dwell = first;
    while (phase && dwell + 1 < end && phase->values[dwell] == 1.0) ++dwell;
    all.push_back({first, end, dwell});
  }
  return all;
}

/// The usual step of a dwell's rows [s].
double sample_of(const PositionRows& p, const RowSpacing& spacing) {
  return stats::upper_median({spacing.usual.begin() + static_cast<std::ptrdiff_t>(p.dwell),
                              spacing.usual.begin() + static_cast<std::ptrdiff_t>(p.end)});
}

/// What is usual of the rows of all dwells [s].
double sample_of_most(const std::vector<PositionRows>& positions, const RowSpacing& spacing) {
  std::vector<double> usual;
  for (const PositionRows& p : positions)
    usual.insert(usual.end(), spacing.usual.begin() + static_cast<std::ptrdiff_t>(p.dwell),
                 spacing.usual.begin() + static_cast<std::ptrdiff_t>(p.end));
  return stats::upper_median(std::move(usual));
}

double in_whole_samples(double length, double sample) {
  return std::round(length / sample) * sample;
}

/// The first row of a dwell that shows its attitude: where the platform is behind its begin.
/// Rows before it are of the turn or of the position before.
std::size_t row_of_attitude(const Recording& r, std::size_t first, std::size_t end) {
  if (first + 2 >= end) return first;
  const auto& time = r.find("time")->values;
  const double free = largest_mismatch / detail::earth_rate;  // [s] that drift needs for that
  std::size_t later = first + std::max<std::size_t>(1, (end - first) / parts_of_a_position);
  while (later > first + 1 && time[later] - time[first] > free) --later;
  const auto there = measured(r, gimbal_channels, later);
  for (std::size_t row = first; there && row < later; ++row)
    if (const auto angles = measured(r, gimbal_channels, row);
        angles &&
        rotation_vector(Mat3(gimbal_chain(*angles).transpose() * gimbal_chain(*there))).norm() <
            largest_mismatch)
      return row;
  return there ? later : first;
}

/// The last row of a dwell whose heading is its own: that of the row before its end part, if
/// the case stood there. Rows behind it are of the turn or of the next position.
std::size_t row_of_heading(const std::vector<double>& heading, std::size_t first, std::size_t end) {
  if (first + 2 >= end) return end - 1;
  const std::size_t own = end - 1 - std::max<std::size_t>(1, (end - first) / parts_of_a_position);
  const auto apart = [&](std::size_t row) {
    return std::abs(std::remainder(heading[row] - heading[own], 360.0 * detail::deg));
  };
  std::size_t row = end - 1;
  constexpr double stands = 0.1 * largest_mismatch;
  if (apart((first + own) / 2) > stands) return row;  // it is turned all the while
  while (apart(row) > stands) --row;
  return row;
}

/// The heading of a case that stands alike in all positions, which are three or more: that by which
/// the level axes of all stand away from one of eight directions, as one wants a platform caged. 0
/// where they do not agree to a degree, the step in which headings are written, or where it is
/// none.
double common_heading(const Recording& r, const std::vector<PositionRows>& rows,
                      const RowSpacing& spacing) {
  constexpr double step = 1.0 * detail::deg, eighth = 45.0 * detail::deg;
  std::vector<double> off;
  for (const auto& [first, end, dwell] : rows) {
    if (dwell > first) return 0.0;  // slewed to: attitudes are carried along
    const std::size_t shows = row_of_attitude(r, dwell, end);
    const auto there = seen_at(r, shows, end, spacing.usual[shows]);
    if (!there) return 0.0;
    int level = 0;
    there->R_lp.row(2).cwiseAbs().minCoeff(&level);
    off.push_back(std::atan2(there->R_lp(1, level), there->R_lp(0, level)));
  }
  if (off.size() < 3) return 0.0;
  double mean = 0.0;
  for (const double x : off) mean += std::remainder(x - off.front(), eighth);
  mean = std::remainder(off.front() + mean / static_cast<double>(off.size()), eighth);
  const bool alike = std::ranges::all_of(
      off, [&](double x) { return std::abs(std::remainder(x - mean, eighth)) < step; });
  return alike && std::abs(mean) > step ? -std::round(mean / step) * step : 0.0;
}

}  // namespace

RecordedPlan recorded_plan(const Recording& r) {
  RecordedPlan plan;
  plan.north = true;
  const Channel *time = r.find("time"), *heading = r.find("case_heading");
  const std::vector<PositionRows> rows = rows_by_position(r);
  const RowSpacing spacing = row_spacing(r);
  plan.sample = as_written(sample_of_most(rows, spacing));
  plan.headings = heading != nullptr;
  if (!heading) plan.faces = common_heading(r, rows, spacing);
  std::vector<TwoUps> seen;
  std::vector<std::string> ups;
  Mat3 drifted = Mat3::Identity();  // the position before, against its nominal attitude; local axes
  for (const auto& [first, end, dwell] : rows) {
    const std::size_t shows = row_of_attitude(r, dwell, end);
    RecordedPlan::Position p{.torqued = dwell > first};
    if (const double own = as_written(sample_of({first, end, dwell}, spacing));
        std::abs(own - plan.sample) > preparation::RecordingLimits::interval_room * plan.sample)
      p.sample = own;
    const double sample = p.sample.value_or(plan.sample);
    p.length = in_whole_samples(time->values[end - 1] - time->values[dwell] + sample, sample);
    if (heading) p.heading = heading->values[row_of_heading(heading->values, dwell, end)];
    if (plan.faces != 0.0) p.heading = plan.faces;
    const std::size_t row = std::min(shows + 2, end - 1);  // the first may be of the turn
    const auto force = measured(r, accelerometer_channels, row),
               angles = measured(r, gimbal_channels, row);
    const auto there = seen_at(r, shows, end, spacing.usual[shows]);
    const bool rough = p.torqued || (force && angles && !show_one_up(*force, *angles));
    if (!p.torqued) drifted.setIdentity();
    const auto in_case = [&](double direction) -> std::optional<planning::ShownAttitude> {
      if (!there) return std::nullopt;
      return planning::shown_attitude(drifted.transpose() * case_attitude(direction) * there->R_lp,
                                      rough ? largest_mismatch : there->room);
    };
    const auto shown = in_case(p.heading.value_or(0.0));
    if (shown)
      drifted = case_attitude(p.heading.value_or(0.0)) * there->R_lp * shown->R_lp.transpose();
    if (!shown) p.heading.reset();  // axes that are guessed may not be reached from it
    plan.north = plan.north && shown;
    const auto turned = in_case(plan.faces + 45.0 * detail::deg);
    if (!heading && shown && turned->plainer_than(*shown)) p.turned = *turned;
    p.attitude = shown ? *shown : planning::ShownAttitude{axes_of(mean_force(r, dwell, end))};
    if (force && angles) {
      seen.push_back({plan.positions.size() + 1, *force, *angles});
      ups.push_back(axes_of(*force));
    }
    const auto command = measured(r, command_channels, dwell);
    p.level = command && command->norm() > 0.5 * detail::earth_rate;
    plan.positions.push_back(std::move(p));
  }
  plan.level = 2 * std::ranges::count(plan.positions, true, &RecordedPlan::Position::level) >
               std::ssize(plan.positions);
  const Channel* const outer = r.find("gimbal_outer");
  if (outer) plan.contradiction = two_ups_text(seen, outer->unit);
  if (plan.contradiction.empty()) return plan;
  // Axes of a misread gimbal would have the accelerometers seem wrong.
  plan.north = false;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    RecordedPlan::Position& p = plan.positions[seen[k].position - 1];
    p.attitude = {ups[k]};
    p.heading.reset();
    p.turned = {};
  }
  return plan;
}

double RecordedPlan::common_dwell() const {
  return std::max(sample, in_whole_samples(positions.front().length, sample));
}

RecordedPlan plan_to_come(std::size_t positions) {
  constexpr double sample = 60.0, dwell = 3600.0;  // [s]
  RecordedPlan plan{.sample = sample, .to_come = true};
  plan.positions.assign(positions, {.length = dwell, .attitude = {"x=N y=W z=U"}});
  return plan;
}

RecordedSite recorded_site(const Recording& recording) {
  RecordedSite site;
  for (const auto& [key, value] : recording.facts) {
    if (key == "latitude") site.latitude = value;
    if (key == "gravity") site.gravity = value;
  }
  return site;
}

}  // namespace drift::cli
