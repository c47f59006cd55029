#include "analysis/preparation/held_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "analysis/preparation/input_thresholds.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/rows/reading_step.hpp"
#include "core/stats/median.hpp"

namespace drift::preparation {
namespace {

bool is_of_a_sensor(std::string_view channel) {
  for (const ChannelTriple& t : {accelerometer_channels, gimbal_channels, gyro_channels})
    if (std::ranges::find(t.names, channel) != t.names.end()) return true;
  return false;
}

/// Equal readings that follow each other.
struct EqualRun {
  std::size_t first = 0, end = 0;

  std::size_t rows() const { return end - first; }
};

/// Runs of a channel, or of one position of it, and those of them that repeat a reading.
struct Repeats {
  double runs = 0.0, repeating = 0.0;

  void count(const EqualRun& run) {
    runs += 1.0;
    repeating += run.rows() > 1 ? 1.0 : 0.0;
  }
  Repeats without(const EqualRun& run) const {
    return {runs - 1.0, repeating - (run.rows() > 1 ? 1.0 : 0.0)};
  }
  /// How many of so many runs chance makes as long, by what was counted alone: the rule of
  /// succession, once for every reading more.
  double as_long(std::size_t rows, double of) const {
    double expected = of;
    for (std::size_t k = 0; k + 1 < rows && expected > RecordingLimits::stuck_by_chance; ++k)
      expected *=
          std::min(1.0, RecordingLimits::once_more * (1.0 + repeating + static_cast<double>(k)) /
                            (2.0 + runs + static_cast<double>(k)));
    return expected;
  }
};

/// Those of a channel's runs that are stuck.
std::vector<EqualRun> stuck_runs(const std::vector<EqualRun>& runs, const Channel* position) {
  // The median over runs: a coarse readout that moves in steps has long runs throughout.
  std::vector<double> lengths;
  for (const EqualRun& run : runs) lengths.push_back(static_cast<double>(run.rows()));
  const double least = static_cast<double>(RecordingLimits::stuck),
               usual = runs.size() < 3 ? 1.0 : stats::upper_median(std::move(lengths));
  Repeats all;
  std::map<double, Repeats> in_position;
  for (const EqualRun& run : runs) {
    all.count(run);
    if (position != nullptr) in_position[position->values[run.first]].count(run);
  }
  std::vector<EqualRun> stuck;
  for (const EqualRun& run : runs) {
    bool stands = static_cast<double>(run.rows()) >= least * usual;
    if (!stands && position != nullptr && run.rows() > 2) {
      const Repeats others = all.without(run),
                    near = in_position[position->values[run.first]].without(run);
      stands = std::max(others.as_long(run.rows(), all.runs),
                        near.repeating > 0.0 ? near.as_long(run.rows(), all.runs) : 0.0) <=
               RecordingLimits::stuck_by_chance;
    }
    if (stands) stuck.push_back(run);
  }
  return stuck;
}

}  // namespace

void leave_out_held_rows(Recording& r, std::vector<std::string>& remarks) {
  std::vector<Channel*> sensors;
  for (const ChannelTriple& triple : {accelerometer_channels, gimbal_channels})
    for (const std::string_view name : triple.names)
      if (const auto c = std::ranges::find(r.channels, name, &Channel::name); c != r.channels.end())
        sensors.push_back(&*c);
  if (sensors.size() < 2) return;
  const Channel* position = r.find("position");
  const auto repeats = [](const Channel* c, std::size_t i) {
    return c->values[i] == c->values[i - 1];  // not where it was not measured
  };
  std::vector<std::size_t> held;
  std::vector<double> alone(sensors.size(),
                            1.0);  // repeats of one channel: by the rule of succession
  double rows = 2.0;
  for (std::size_t i = 1; i < r.rows(); ++i) {
    if (position && position->values[i] != position->values[i - 1]) continue;
    if (std::ranges::all_of(sensors, [&](const Channel* c) { return repeats(c, i); })) {
      held.push_back(i);
      continue;
    }
    rows += 1.0;
    for (std::size_t k = 0; k < sensors.size(); ++k) alone[k] += repeats(sensors[k], i) ? 1.0 : 0.0;
  }
  double expected = rows;  // rows in which all repeat by chance
  for (const double times : alone) expected *= times / rows;
  if (held.empty() || expected > HeldLimits::chance ||
      static_cast<double>(held.size()) > HeldLimits::most * rows)
    return;
  remarks.push_back(
      fmt::format("{}: {} rows repeat the row before in all {} sensors to the last digit, the "
                  "first in line {}: "
                  "values that were held, taken as not measured",
                  r.source.empty() ? "recording" : r.source, held.size(), sensors.size(),
                  r.lines[held.front()]));
  for (Channel* c : sensors)
    for (const std::size_t i : held) c->values[i] = std::numeric_limits<double>::quiet_NaN();
}

std::vector<StuckRows> stuck_rows(const Recording& r) {
  const Channel* position = r.find("position");
  std::vector<StuckRows> all;
  for (const Channel& c : r.channels) {
    if (!is_of_a_sensor(c.name)) continue;
    std::vector<EqualRun> runs;
    for (std::size_t i = 0; i < c.values.size();) {
      std::size_t end = i + 1;
      while (end < c.values.size() && c.values[end] == c.values[i]) ++end;
      if (std::isfinite(c.values[i])) runs.push_back({i, end});
      i = end;
    }
    if (runs.empty() || reading_step(c, position)) continue;  // coarse, as the quality card says
    for (const EqualRun& run : stuck_runs(runs, position))
      all.push_back({c.name, run.first, run.end});
  }
  return all;
}

void leave_out_stuck(Recording& r, std::vector<std::string>& remarks) {
  const std::vector<StuckRows> stuck = stuck_rows(r);
  for (Channel& c : r.channels) {
    std::size_t lost = 0, line = 0, places = 0;
    for (const StuckRows& rows : stuck) {
      if (rows.channel != c.name) continue;
      if (lost == 0) line = r.lines[rows.first];
      lost += rows.end - rows.first;
      ++places;
      std::fill(c.values.begin() + static_cast<std::ptrdiff_t>(rows.first),
                c.values.begin() + static_cast<std::ptrdiff_t>(rows.end),
                std::numeric_limits<double>::quiet_NaN());
    }
    if (lost > 0)
      remarks.push_back(
          fmt::format("{}: {} stands still for {} samples{}, from line {} on: taken as a stuck "
                      "sensor, or one at the end of its range, and left out",
                      r.source.empty() ? "recording" : r.source, c.name, lost,
                      places > 1 ? fmt::format(" in {} places together", places) : "", line));
  }
}

Recording without_held_rows(Recording recording) {
  std::vector<std::string> remarks;
  leave_out_held_rows(recording, remarks);
  return recording;
}

}  // namespace drift::preparation
