#include "analysis/blind/outside_effects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/physics/gimbals.hpp"

namespace drift::blind {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

/// The nominal platform in the middle of an interval.
struct Instant {
  const Interval* interval;
  double t = 0.0;         ///< since the start of the test [s]
  double in_dwell = 0.0;  ///< since the first interval of the position [s]
  Vec3 f_p, gimbal;
};

/// A pattern of unit size along one axis, from a function of the instant.
Mat3X pattern(const World& world, int axis, const std::function<double(const Instant&)>& value) {
  const Timeline& line = world.timeline;
  Mat3X out = Mat3X::Zero(3, world.intervals());
  double start = 0.0;
  int position = -1;
  for (std::size_t i = 0; i < line.intervals.size(); ++i) {
    const Interval& interval = line.intervals[i];
    if (interval.position != position) {
      position = interval.position;
      start = interval.t0;
    }
    const Node& node = line.nodes[interval.middle_node()];
    Instant now{&interval, node.t - line.intervals.front().t0, node.t - start,
                Vec3(node.R_lr.row(2)), Vec3::Zero()};
    const double heading = 0.5 * (interval.heading0 + interval.heading1);
    now.gimbal = gimbal_angles<double>(case_attitude(heading).transpose() * node.R_lr);
    out(axis, static_cast<Eigen::Index>(i)) = value(now);
  }
  return out;
}

int pick(int n, Stream& stream) {
  return static_cast<int>(stream.uniform() * n);
}

enum class Slot { rate, accelerometer, gimbal };

const Unit& unit_of(Slot slot) {
  return slot == Slot::rate            ? unit::deg_per_h
         : slot == Slot::accelerometer ? unit::ug
                                       : unit::arcsec;
}

/// A source that adds a pattern to one slot; strength 1 is one of its unit.
Source source(std::string name, std::string words, Slot slot, int axis, Mat3X shape) {
  static constexpr const char* axes[] = {"x", "y", "z"};
  static constexpr const char* gimbals[] = {"outer", "middle", "inner"};
  Source s;
  s.effect.term = std::move(name);
  s.effect.axis = slot == Slot::gimbal ? gimbals[axis] : axes[axis];
  s.effect.words = std::move(words);
  s.first = 1.0;
  s.most = 1e6;
  s.put = [slot, shape = std::move(shape)](World& w, double strength) {
    Mat3X& to = slot == Slot::rate            ? w.disturbance
                : slot == Slot::accelerometer ? w.acc_error
                                              : w.gimbal_error;
    World::add(to, shape, strength * unit_of(slot).to_si);
  };
  s.parameters = [slot](double strength) {
    return std::vector<HiddenParameter>{
        {"amplitude", strength, std::string(unit_of(slot).symbol.view())}};
  };
  return s;
}

}  // namespace

Source outside_source(std::size_t kind, const World& world, Stream& stream) {
  const int axis = pick(3, stream);
  const Mounting& mounting = world.truth.mounting;
  const auto along = [&mounting, axis](const Vec3& f, bool spin) {
    Inputs<double> in{};
    in.mounting = &mounting;
    in.f_p = f;
    return spin ? in.f_spin()[axis] : f[axis];
  };
  switch (kind % num_outside) {
    case 0:
      return source("product_drift", "drift a_I^2 a_S", Slot::rate, axis,
                    pattern(world, axis, [&](const Instant& n) {
                      const double a = along(n.f_p, false);
                      return -a * a * along(n.f_p, true);
                    }));
    case 1: {
      const int gimbal = pick(3, stream), force = pick(3, stream);
      return source("gimbal_force", "drift sin(3 gimbal angle) times specific force", Slot::rate,
                    axis, pattern(world, axis, [=](const Instant& n) {
                      return -std::sin(3.0 * n.gimbal[gimbal]) * n.f_p[force];
                    }));
    }
    case 2: {
      std::vector<int> chosen;
      while (chosen.size() <
             std::min<std::size_t>(3, static_cast<std::size_t>(world.timeline.positions))) {
        const int p = pick(world.timeline.positions, stream);
        if (std::find(chosen.begin(), chosen.end(), p) == chosen.end()) chosen.push_back(p);
      }
      std::vector<double> half(static_cast<std::size_t>(world.timeline.positions), 0.0);
      for (const Interval& i : world.timeline.intervals) half[i.position] += 0.5 * i.length();
      return source("intermittent", "drift that is on late in three positions", Slot::rate, axis,
                    pattern(world, axis, [&](const Instant& n) {
                      const bool on = std::find(chosen.begin(), chosen.end(),
                                                n.interval->position) != chosen.end();
                      return on && n.in_dwell > half[n.interval->position] ? -1.0 : 0.0;
                    }));
    }
    case 3: {
      const double T0 = (100.0 + 60.0 * stream.uniform()) * 60.0, phase = two_pi * stream.uniform();
      return source("chirp", "drift whose period shrinks through the test", Slot::rate, axis,
                    pattern(world, axis, [=](const Instant& n) {
                      return std::sin(two_pi * (n.t / T0) * (n.t / T0) + phase);
                    }));
    }
    case 4: {
      const double phase = two_pi * stream.uniform();
      return source("acc_pickup", "accelerometer error with a period of 47 min",
                    Slot::accelerometer, axis, pattern(world, axis, [=](const Instant& n) {
                      return std::sin(two_pi * n.t / 2820.0 + phase) *
                             (0.3 + std::abs(n.f_p[axis]));
                    }));
    }
    default: {
      const double period = (20.0 + 10.0 * stream.uniform()) * 60.0;
      return source("resolver_sawtooth", "resolver error that builds up and falls back",
                    Slot::gimbal, axis, pattern(world, axis, [=](const Instant& n) {
                      return n.t / period - std::floor(n.t / period) - 0.5;
                    }));
    }
  }
}

Source local_source(const World& world, Stream& stream) {
  static constexpr Slot slots[] = {Slot::rate, Slot::rate, Slot::accelerometer, Slot::gimbal};
  static constexpr const char* equations[] = {"platform rate", "platform rate", "accelerometer",
                                              "gimbal"};
  const int axis = pick(3, stream), which = pick(4, stream),
            position = pick(world.timeline.positions, stream);
  double start = 0.0, end = 0.0;
  bool found = false;
  for (const Interval& i : world.timeline.intervals)
    if (i.position == position && !i.slew) {
      if (!found) start = i.t0;
      found = true;
      end = i.t1;
    }
  const double length = end - start, share = 0.25 + 0.25 * stream.uniform();
  const double from = start + (1.0 - share) * stream.uniform() * length, to = from + share * length;
  const auto inside = [=](const Instant& n) {
    const double middle = 0.5 * (n.interval->t0 + n.interval->t1);
    return middle > from && middle < to ? 1.0 : 0.0;
  };
  const Slot slot = slots[which];
  Source s = source("local", "a constant disturbance in one window", slot, axis,
                    pattern(world, axis, inside));
  s.effect.position = position + 1;
  s.effect.start_s = from;
  s.effect.end_s = to;
  s.effect.equation = fmt::format("{} {}", equations[which], s.effect.axis);
  return s;
}

}  // namespace drift::blind
