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

/// The study's test recorded each second. Declared is the noise of a minute's mean; the gimbals
/// are read without noise.
inline Recording second_by_second(mc::Study study) {
  for (Position& p : study.plan.positions) p.sample = 1.0;
  study.readout.accelerometer_noise *= std::sqrt(60.0);
  study.readout.gimbal_noise = 1e-12;
  const Timeline timeline = lay_out(study.plan, study.site);
  const TruthDraw draw = draw_truth(study.truth, timeline.chains, 1, 0);
  return make_recording(timeline,
                        Simulator(study.truth, study.readout).run(timeline, draw, 1, 0).measured,
                        study.readout);
}

namespace rows_kept {

/// A row that is kept: rows [first, end) of the fine recording, and the minute it ends nearest to.
struct Kept {
  std::size_t first = 0, end = 0;
  std::uint64_t minute = 0;
};

/// Every stretch of one command is divided for itself.
inline std::vector<Kept> kept_rows(const Recording& fine, Rows rows, Stream& random) {
  const auto same = [&](std::size_t k) {
    return std::ranges::all_of(
        std::vector<std::string_view>{"position", "phase", "cmd_x", "cmd_y", "cmd_z"},
        [&](std::string_view name) {
          const auto& v = fine.find(name)->values;
          return v[k] == v[k - 1];
        });
  };
  std::vector<Kept> all;
  std::uint64_t minutes_before = 0;
  for (std::size_t first = 0; first < fine.rows();) {
    std::size_t end = first + 1;
    while (end < fine.rows() && same(end)) ++end;
    const bool slew = fine.find("phase")->values[first] == 1.0;
    const bool seconds = rows == Rows::each_second || rows == Rows::seconds_lost ||
                         (rows == Rows::seconds_in_slews && slew);
    const std::size_t minutes = std::max<std::size_t>(1, (end - first + 30) / 60);
    const std::size_t parts = seconds ? end - first : minutes;
    for (std::size_t k = 1; k <= parts; ++k) {
      const std::size_t from = k == 1 ? first : all.back().end;
      std::size_t at = first + (end - first) * k / parts;
      if (rows == Rows::jittered && k > 1 && k < parts)
        at = at - 3 + static_cast<std::size_t>(7.0 * random.uniform());
      const std::size_t minute = ((at - first) * minutes + (end - first) / 2) / (end - first);
      all.push_back({from, at, minutes_before + minute});
    }
    minutes_before += minutes + 1;
    first = end;
  }
  return all;
}

}  // namespace rows_kept

/// A recording of one row a second as a logger would have kept it. gimbal_noise [rad]: of a
/// reading, one and the same for all readings nearest to a minute, so that what loggers of other
/// habits have read differs by their habits alone.
inline Recording with_rows(const Recording& fine, Rows rows, double gimbal_noise = 0.0,
                           std::uint64_t seed = 1) {
  Stream random(seed, 0, Purpose::test);
  std::vector<rows_kept::Kept> kept = rows_kept::kept_rows(fine, rows, random);
  if (rows == Rows::minutes_lost || rows == Rows::seconds_lost)
    std::erase_if(kept, [&](const rows_kept::Kept&) { return random.uniform() < 0.1; });
  Recording out;
  for (const Channel& c : fine.channels) {
    Channel thin{c.name, c.unit, {}};
    for (const rows_kept::Kept& row : kept) {
      double sum = 0.0;
      for (std::size_t k = row.first; k < row.end; ++k) sum += c.values[k];
      double value = c.values[row.end - 1];
      if (c.name.starts_with("acc_")) value = sum / static_cast<double>(row.end - row.first);
      if (c.name.starts_with("gimbal_"))
        value +=
            gimbal_noise * Stream(seed, row.minute, Purpose::test, stream_index(c.name)).normal();
      thin.values.push_back(value);
    }
    out.channels.push_back(std::move(thin));
  }
  for (std::size_t k = 0; k < out.rows(); ++k) out.lines.push_back(k + 2);
  return out;
}

}  // namespace drift::test
