#include "analysis/preparation/fillers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "analysis/preparation/input_thresholds.hpp"
#include "core/recording/recording_channels.hpp"

namespace drift::preparation {
namespace {

/// Rows of a position whose number is one and the same.
struct Run {
  std::size_t first = 0, last = 0;
};

/// Whether no row beside the run, in its position, is near it: at least one is there.
bool stands_apart(const std::vector<double>& x, const Channel& position, const Run& run,
                  double apart, bool angle) {
  const double value = x[run.first];
  std::size_t beside = 0;
  const auto far = [&](std::size_t row) {
    if (position.values[row] != position.values[run.first] || !std::isfinite(x[row])) return true;
    ++beside;
    const double by = x[row] - value;
    return std::abs(angle ? std::remainder(by, 360.0 * detail::deg) : by) > apart;
  };
  const bool alone =
      (run.first == 0 || far(run.first - 1)) && (run.last + 1 == x.size() || far(run.last + 1));
  return alone && beside > 0;
}

/// The runs of every number that stands apart wherever it is.
std::vector<std::vector<Run>> apart_everywhere(const Channel& c, const Channel& position,
                                               double apart, bool angle) {
  std::map<double, std::vector<Run>> runs;
  std::set<double> near;  // somewhere
  for (std::size_t i = 0; i < c.values.size();) {
    std::size_t end = i + 1;
    while (end < c.values.size() && c.values[end] == c.values[i] &&
           position.values[end] == position.values[i])
      ++end;
    if (std::isfinite(c.values[i])) {
      const Run run{i, end - 1};
      runs[c.values[i]].push_back(run);
      if (!stands_apart(c.values, position, run, apart, angle)) near.insert(c.values[i]);
    }
    i = end;
  }
  std::vector<std::vector<Run>> all;
  for (auto& [value, its] : runs)
    if (!near.contains(value)) all.push_back(std::move(its));
  return all;
}

}  // namespace

void leave_out_fillers(Recording& r, std::vector<std::string>& remarks) {
  const Channel* const found = r.find("position");
  if (found == nullptr) return;
  const Channel position = *found;
  for (const ChannelTriple& triple : {accelerometer_channels, gimbal_channels})
    for (const std::string_view name : triple.names) {
      const auto c = std::ranges::find(r.channels, name, &Channel::name);
      if (c == r.channels.end()) continue;
      const bool angle = name.starts_with("gimbal_");
      const double apart = angle ? FillerLimits::angle : FillerLimits::force;
      for (const std::vector<Run>& runs : apart_everywhere(*c, position, apart, angle)) {
        std::size_t rows = 0;
        std::set<double> positions;
        for (const Run& run : runs) {
          rows += run.last - run.first + 1;
          positions.insert(position.values[run.first]);
        }
        if (rows < FillerLimits::rows || positions.size() < FillerLimits::positions) continue;
        remarks.push_back(
            fmt::format("{}: {} reads {:.10g} {} in {} rows, the first in line {}, far from what "
                        "is beside them: "
                        "taken as not measured",
                        r.source.empty() ? "recording" : r.source, name,
                        c->values[runs.front().first] / c->unit.to_si, c->unit.symbol.view(), rows,
                        r.lines[runs.front().first]));
        for (const Run& run : runs)
          std::fill(c->values.begin() + static_cast<std::ptrdiff_t>(run.first),
                    c->values.begin() + static_cast<std::ptrdiff_t>(run.last) + 1,
                    std::numeric_limits<double>::quiet_NaN());
      }
    }
}

}  // namespace drift::preparation
