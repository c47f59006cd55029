#include "core/sim/measurements.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/check.hpp"
#include "core/recording/recording_channels.hpp"

namespace drift {
namespace {

constexpr std::array<const char*, 3> acc_names{"acc_x", "acc_y", "acc_z"};
constexpr std::array<const char*, 3> gimbal_names{"gimbal_outer", "gimbal_middle", "gimbal_inner"};
constexpr std::array<const char*, 3> cmd_names{"cmd_x", "cmd_y", "cmd_z"};

}  // namespace

std::optional<NonfiniteSample> nonfinite_sample(const Measurements& measured,
                                                const Readout& readout, std::size_t first,
                                                std::size_t end) {
  for (std::size_t k = first; k < end; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    for (std::size_t a = 0; a < 3; ++a) {
      const auto axis = static_cast<Eigen::Index>(a);
      if (readout.accelerometers && !std::isfinite(measured.acc(axis, i)))
        return NonfiniteSample{k, acc_names[a], true};
      if (readout.gimbals && !std::isfinite(measured.gimbal(axis, i)))
        return NonfiniteSample{k, gimbal_names[a], false};
    }
  }
  return std::nullopt;
}

Measurements measurements_of(const Recording& recording, const Readout& readout) {
  const auto rows = static_cast<Eigen::Index>(recording.rows());
  const double missing = std::numeric_limits<double>::quiet_NaN();
  Measurements m{Mat3X::Constant(3, rows, missing), Mat3X::Constant(3, rows, missing)};
  const auto fill = [&](Mat3X& into, int axis, const char* name) {
    if (const Channel* c = recording.find(name))
      into.row(axis) = Eigen::Map<const Eigen::RowVectorXd>(c->values.data(), rows);
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (readout.accelerometers) fill(m.acc, axis, acc_names[axis]);
    if (readout.gimbals) fill(m.gimbal, axis, gimbal_names[axis]);
  }
  return m;
}

Recording make_recording(const Timeline& timeline, const Measurements& measured,
                         const Readout& readout) {
  DRIFT_DEMAND(is_along(measured, timeline));
  Recording rec;
  const std::size_t n = timeline.intervals.size();
  const auto add = [&](std::string_view name, const Unit& unit, auto&& value) {
    Channel c{std::string(name), unit, std::vector<double>(n)};
    for (std::size_t i = 0; i < n; ++i) c.values[i] = value(i);
    rec.channels.push_back(std::move(c));
  };
  const auto interval = [&](std::size_t i) -> const Interval& { return timeline.intervals[i]; };
  add("time", unit::s, [&](std::size_t i) { return interval(i).t1; });
  add("position", unit::one, [&](std::size_t i) { return interval(i).position + 1.0; });
  add("phase", unit::one, [&](std::size_t i) { return interval(i).slew ? 1.0 : 0.0; });
  for (int a = 0; a < 3; ++a)
    if (readout.accelerometers)
      add(acc_names[a], unit::g, [&](std::size_t i) { return measured.acc(a, i); });
  for (int a = 0; a < 3; ++a)
    if (readout.gimbals)
      add(gimbal_names[a], unit::deg, [&](std::size_t i) { return measured.gimbal(a, i); });
  for (int a = 0; a < 3; ++a)
    add(cmd_names[a], unit::deg_per_h, [&](std::size_t i) { return interval(i).omega_cmd_p[a]; });
  add("case_heading", unit::deg, [&](std::size_t i) { return interval(i).heading1; });
  for (int a = 0; timeline.loop_told && a < 6; ++a)
    add(loop_channels[static_cast<std::size_t>(a)], unit::arcsec,
        [&](std::size_t i) { return interval(i).loop[a]; });
  for (const CovariateSpec& c : known_covariates)
    for (std::size_t k = 0; timeline.carries(c) && k < c.components(); ++k)
      add(c.column(k), c.unit, [&, at = c.first + k](std::size_t i) {
        return timeline.mean.value[at] + interval(i).around1.value[at];
      });
  for (std::size_t i = 0; i < n; ++i) rec.lines.push_back(i + 1);
  return rec;
}

}  // namespace drift
