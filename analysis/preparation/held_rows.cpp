#include "analysis/preparation/held_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/preparation/input_thresholds.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/rows/reading_step.hpp"

namespace drift::preparation {
namespace {

bool is_of_a_sensor(std::string_view channel) {
  for (const ChannelTriple& t : {accelerometer_channels, gimbal_channels, gyro_channels})
    if (std::ranges::find(t.names, channel) != t.names.end()) return true;
  return false;
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

void leave_out_stuck(Recording& r, std::vector<std::string>& remarks) {
  for (Channel& c : r.channels) {
    if (!is_of_a_sensor(c.name)) continue;
    struct Run {
      std::size_t first, end;
    };
    std::vector<Run> runs;
    for (std::size_t i = 0; i < c.values.size();) {
      std::size_t end = i + 1;
      while (end < c.values.size() && c.values[end] == c.values[i]) ++end;
      if (std::isfinite(c.values[i])) runs.push_back({i, end});
      i = end;
    }
    if (reading_step(c, r.find("position"))) continue;  // coarse, as the quality card says
    std::vector<std::size_t> lengths;
    for (const Run& run : runs) lengths.push_back(run.end - run.first);
    if (lengths.empty()) continue;
    // The median over runs: a coarse readout that moves in steps has long runs throughout.
    std::ranges::nth_element(lengths,
                             lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2));
    const std::size_t usual = runs.size() < 3 ? 1 : lengths[lengths.size() / 2];
    std::size_t lost = 0, line = 0;
    for (const Run& run : runs) {
      if (run.end - run.first < std::max(RecordingLimits::stuck, RecordingLimits::stuck * usual))
        continue;
      if (lost == 0) line = r.lines[run.first];
      lost += run.end - run.first;
      std::fill(c.values.begin() + static_cast<std::ptrdiff_t>(run.first),
                c.values.begin() + static_cast<std::ptrdiff_t>(run.end),
                std::numeric_limits<double>::quiet_NaN());
    }
    if (lost > 0)
      remarks.push_back(fmt::format(
          "{}: {} stands still for {} samples, from line {} on: taken as a stuck sensor, or one at "
          "the end of its range, and left out",
          r.source.empty() ? "recording" : r.source, c.name, lost, line));
  }
}

Recording without_held_rows(Recording recording) {
  std::vector<std::string> remarks;
  leave_out_held_rows(recording, remarks);
  return recording;
}

}  // namespace drift::preparation
