#include "analysis/preparation/held_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/preparation/input_thresholds.hpp"
#include "core/recording/recording_channels.hpp"

namespace drift::preparation {

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

}  // namespace drift::preparation
