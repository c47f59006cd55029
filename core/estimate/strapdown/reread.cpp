#include "core/estimate/strapdown/reread.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"
#include "core/sim/kinematics.hpp"

namespace drift::strapdown {
namespace {

/// Rounds of a solution by iteration: sensors are within some hundredths of ideal ones, so each
/// takes that factor off the error.
constexpr int rounds = 8;

/// What is read at one instant.
struct Reading {
  Vec3 gyro, acc;  ///< [rad/s], [g]
};

/// The interval that an instant lies in, or the nearest one.
const Interval& interval_at(const Timeline& timeline, double t) {
  const auto after = std::ranges::lower_bound(timeline.intervals, t, {}, &Interval::t1);
  if (after == timeline.intervals.end()) return timeline.intervals.back();
  if (after == timeline.intervals.begin() || after->t0 <= t) return *after;
  const auto before = std::prev(after);
  return t - before->t1 < after->t0 - t ? *before : *after;
}

class Rereading {
 public:
  Rereading(const CaseTest& test, const CaseSensors& own, const CaseSensors& others)
      : timeline_(test.timeline),
        own_(own),
        others_(others),
        needs_(TermLibrary::needs(own.model.terms) | TermLibrary::needs(others.model.terms)) {
    DRIFT_DEMAND(!needs_.memory && !needs_.turning);
  }

  /// What others read where `was` is read at time t.
  Reading of(double t, const Reading& was) const {
    const Interval& interval = interval_at(timeline_, t);
    const double at = std::clamp(t, interval.t0, interval.t1),
                 part = (at - interval.t0) / interval.length();
    const auto step = static_cast<std::size_t>(
        std::lround(part * static_cast<double>(interval.node_count() - 1)));
    const Node& node = timeline_.nodes[interval.first_node + step];
    Scene<double> scene(node.omega_ic_l, was.gyro, own_.model.mounting, node.R_lr);
    if (needs_.any())
      scene.look_around(needs_, moment_at(timeline_, interval, at), node.R_lr, nullptr);
    Inputs<double>& in = scene.in;
    in.f_p = was.acc;
    for (int k = 0; k < rounds; ++k) in.f_p += was.acc - acc(own_, in);
    const Vec3 omega_ip_p = rate(own_, in);
    for (int k = 0; k < rounds; ++k) in.omega_cmd_p += omega_ip_p - rate(others_, in);
    return {in.omega_cmd_p, acc(others_, in)};
  }

 private:
  static Vec3 acc(const CaseSensors& sensors, const Inputs<double>& in) {
    return accelerometer_output(sensors.model, in, sensors.theta.data());
  }
  static Vec3 rate(const CaseSensors& sensors, const Inputs<double>& in) {
    static const MisalignmentAngles no_loop = MisalignmentAngles::Zero();
    return platform_rate(sensors.model, in, sensors.theta.data(),
                         misalignment_matrix(sensors.model.mounting, no_loop));
  }

  const Timeline& timeline_;
  const CaseSensors &own_, &others_;
  Needs needs_;
};

}  // namespace

Signals reread(const Signals& signals, const std::vector<Dwell>& dwells, const CaseTest& test,
               const CaseSensors& own, const CaseSensors& others) {
  const Rereading rereading(test, own, others);
  Signals out = signals;
  auto dwell = dwells.begin();
  for (std::size_t k = 0; k < signals.size(); ++k) {
    if (!signals.measured(k)) continue;
    while (dwell != dwells.end() && dwell->last < k) ++dwell;
    const bool rests = dwell != dwells.end() && k >= dwell->first;
    const Reading was =
        rests ? Reading{dwell->gyro, dwell->acc} : Reading{signals.gyro[k], signals.acc[k]};
    const Reading is = rereading.of(signals.time[k], was);
    out.gyro[k] += is.gyro - was.gyro;
    out.acc[k] += is.acc - was.acc;
  }
  return out;
}

}  // namespace drift::strapdown
