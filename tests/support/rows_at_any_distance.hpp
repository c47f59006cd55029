#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/rng.hpp"
#include "core/sim/measurements.hpp"
#include "core/sim/simulate.hpp"
#include "mc/study/study.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::test {

/// How a logger keeps a test that happens second by second.
enum class Rows {
  each_second,
  each_minute,       ///< a row ends with every command; others 60 s apart
  seconds_in_slews,  ///< and minutes in dwells
  jittered,          ///< minutes, but for 3 s; the first of every command is on time
  minutes_lost,      ///< one of ten, at random
  seconds_lost,      ///< likewise
};

/// A test of slewed positions, sample 60 s; the truth is drawn and `truth` added.
inline mc::Study slewing_study(double dwell, Coupling truth, Coupling filter) {
  mc::Study s;
  s.path = "study.toml";
  s.site = harbin;
  PlanDefaults defaults;
  defaults.dwell = dwell;
  s.plan = preset_plan("slew12", defaults).value();
  s.truth = base_truth(truth);
  s.filters = {base_filter(filter)};
  s.monte_carlo.seed = 1;
  return s;
}

/// The study's test recorded each second. Declared is the noise of a minute's mean.
inline Recording second_by_second(mc::Study study) {
  for (Position& p : study.plan.positions) p.sample = 1.0;
  study.readout.accelerometer_noise *= std::sqrt(60.0);
  const Timeline timeline = lay_out(study.plan, study.site);
  const TruthDraw draw = draw_truth(study.truth, timeline.chains, 1, 0);
  return make_recording(timeline,
                        Simulator(study.truth, study.readout).run(timeline, draw, 1, 0).measured,
                        study.readout);
}

namespace detail {

/// Ends of rows [first, end) that become one, of every stretch of one command.
inline std::vector<std::size_t> ends_of(const Recording& fine, Rows rows, Stream& random) {
  const auto same = [&](std::size_t k) {
    return std::ranges::all_of(
        std::vector<std::string_view>{"position", "phase", "cmd_x", "cmd_y", "cmd_z"},
        [&](std::string_view name) {
          const auto& v = fine.find(name)->values;
          return v[k] == v[k - 1];
        });
  };
  std::vector<std::size_t> ends;
  for (std::size_t first = 0; first < fine.rows();) {
    std::size_t end = first + 1;
    while (end < fine.rows() && same(end)) ++end;
    const bool slew = fine.find("phase")->values[first] == 1.0;
    const bool seconds = rows == Rows::each_second || rows == Rows::seconds_lost ||
                         (rows == Rows::seconds_in_slews && slew);
    const auto parts = seconds ? end - first : std::max<std::size_t>(1, (end - first + 30) / 60);
    for (std::size_t k = 1; k <= parts; ++k) {
      std::size_t at = first + (end - first) * k / parts;
      if (rows == Rows::jittered && k > 1 && k < parts)
        at = at - 3 + static_cast<std::size_t>(7.0 * random.uniform());
      ends.push_back(at);
    }
    first = end;
  }
  return ends;
}

}  // namespace detail

/// A recording of one row a second as a logger would have kept it.
inline Recording with_rows(const Recording& fine, Rows rows, std::uint64_t seed = 1) {
  Stream random(seed, 0, Purpose::test);
  std::vector<std::size_t> ends = detail::ends_of(fine, rows, random), first(ends.size());
  for (std::size_t k = 1; k < ends.size(); ++k) first[k] = ends[k - 1];
  std::vector<bool> kept(ends.size(), true);
  if (rows == Rows::minutes_lost || rows == Rows::seconds_lost)
    for (std::size_t k = 0; k < kept.size(); ++k) kept[k] = random.uniform() >= 0.1;
  Recording out;
  for (const Channel& c : fine.channels) {
    Channel thin{c.name, c.unit, {}};
    for (std::size_t k = 0; k < ends.size(); ++k) {
      if (!kept[k]) continue;
      double sum = 0.0;
      for (std::size_t row = first[k]; row < ends[k]; ++row) sum += c.values[row];
      thin.values.push_back(c.name.starts_with("acc_")
                                ? sum / static_cast<double>(ends[k] - first[k])
                                : c.values[ends[k] - 1]);
    }
    out.channels.push_back(std::move(thin));
  }
  for (std::size_t k = 0; k < out.rows(); ++k) out.lines.push_back(k + 2);
  return out;
}

}  // namespace drift::test
