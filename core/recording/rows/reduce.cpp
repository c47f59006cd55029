#include "core/recording/rows/reduce.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/check.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/rows/angles_around.hpp"
#include "core/recording/rows/line_at_end.hpp"
#include "core/recording/rows/row_spacing.hpp"
#include "core/stats/median.hpp"

namespace drift {
namespace {

/// Rows first..end of one stretch.
struct Joined {
  std::size_t first = 0, end = 0;
  bool position_begins = false;
  bool cut = false;  ///< from the stretch before: position, phase, command or heading changed
};

class Cutter {
 public:
  Cutter(const Recording& r, double interval, std::size_t factor)
      : time_(r.find("time")->values),
        interval_(interval),
        length_(interval * static_cast<double>(factor)) {
    position_ = r.find("position");
    phase_ = r.find("phase");
    heading_ = r.find("case_heading");
    for (const Channel& c : r.channels)
      if (c.name.starts_with("cmd_")) commands_.push_back(&c);
  }

  std::vector<Joined> cut() const {
    std::vector<Joined> all;
    double origin = 0.0;
    for (std::size_t row = 0; row < time_.size(); ++row) {
      const bool position_changed =
          row == 0 || (position_ && position_->values[row] != position_->values[row - 1]);
      if (position_changed || cut_before(row, all.back())) {
        origin = position_changed ? time_[row] - interval_ : time_[row - 1];
        all.push_back({row, row + 1, position_changed, true});
      } else if (bin(row, origin) != bin(row - 1, origin)) {
        all.push_back({row, row + 1});
      } else {
        all.back().end = row + 1;
      }
    }
    return all;
  }

 private:
  double bin(std::size_t row, double origin) const {
    return std::floor((time_[row] - origin - 0.5 * interval_) / length_);
  }

  bool cut_before(std::size_t row, const Joined& open) const {
    if (phase_ && phase_->values[row] != phase_->values[row - 1]) return true;
    for (const Channel* c : commands_)
      if (std::abs(c->values[row] - c->values[open.first]) > same_command) return true;
    if (!heading_ || row < open.first + 2) return false;
    const auto& h = heading_->values;
    const double slope =
        (h[open.first + 1] - h[open.first]) / (time_[open.first + 1] - time_[open.first]);
    return std::abs(h[row] - h[open.first] - slope * (time_[row] - time_[open.first])) >
           same_heading;
  }

  const std::vector<double>& time_;
  const Channel* position_ = nullptr;
  const Channel* phase_ = nullptr;
  const Channel* heading_ = nullptr;
  std::vector<const Channel*> commands_;
  double interval_, length_;
};

/// Mean over a stretch of `expected` samples, from those that are there: the value of the straight
/// line through them at its centre.
double bridged_mean(const std::vector<double>& t, const std::vector<double>& x, const Joined& s,
                    double interval, double expected) {
  const double centre = 0.5 * (t[s.first] + t[s.end - 1]);
  double n = 0.0, mt = 0.0, mx = 0.0;
  for (std::size_t i = s.first; i < s.end; ++i) {
    if (!std::isfinite(x[i])) continue;
    n += 1.0;
    mt += t[i] - centre;
    mx += x[i];
  }
  if (!(n >= 0.5 * expected)) return nan_value;
  mt /= n;
  mx /= n;
  if (std::abs(mt) < 1e-9 * interval) return mx;
  double tt = 0.0, tx = 0.0;
  for (std::size_t i = s.first; i < s.end; ++i) {
    if (!std::isfinite(x[i])) continue;
    tt += (t[i] - centre - mt) * (t[i] - centre - mt);
    tx += (t[i] - centre - mt) * (x[i] - mx);
  }
  return tt > 0.0 ? mx - tx / tt * mt : mx;
}

/// Angle by which the platform may turn while `length` seconds pass at a row; more than any if it
/// slews as nobody noted.
double turn_at(const Recording& r, std::size_t row, double length) {
  const Channel* phase = r.find("phase");
  const auto command = measured(r, command_channels, row);
  if (!command && phase != nullptr && phase->values[row] == 1.0) return HUGE_VAL;
  return ((command ? command->norm() : 0.0) + detail::earth_rate) * length;
}

/// The gimbal angles of every stretch, where rows are fine enough for them to be from several
/// readings: `out` has those at the end of each.
void take_angles_around(const Recording& recording, const std::vector<Joined>& stretches,
                        const AnglesAround& around, Recording& out) {
  std::vector<std::pair<const Channel*, Channel*>> gimbals;
  for (Channel& c : out.channels)
    if (c.name.starts_with("gimbal_")) gimbals.emplace_back(recording.find(c.name), &c);
  if (gimbals.empty() || !around.fits()) return;
  const auto& t = recording.find("time")->values;
  out.readings.assign(stretches.size(), 1.0);
  for (std::size_t first = 0, end = 0; first < stretches.size(); first = end) {
    end = first + 1;
    while (end < stretches.size() && !stretches[end].cut) ++end;
    for (std::size_t s = first; s < end; ++s) {
      const std::size_t row = stretches[s].end - 1;
      if (!around.around(row, stretches[first].first, stretches[end - 1].end - 1, t) ||
          turn_at(recording, row, around.length()) > AnglesAround::largest_turn)
        continue;
      std::vector<double> angles;
      for (const auto& [fine, coarse] : gimbals) angles.push_back(around.at(fine->values, row));
      if (!std::ranges::all_of(angles, [](double x) { return std::isfinite(x); })) continue;
      for (std::size_t k = 0; k < gimbals.size(); ++k) gimbals[k].second->values[s] = angles[k];
      out.readings[s] = around.readings();
    }
  }
}

}  // namespace

SampleIntervals sample_intervals(const Recording& recording) {
  SampleIntervals found{nan_value, std::numeric_limits<double>::infinity()};
  const auto& t = recording.find("time")->values;
  const Channel* position = recording.find("position");
  std::vector<double> steps;
  for (std::size_t first = 0, end = 0; first < t.size(); first = end) {
    end = first + 1;
    while (end < t.size() && (!position || position->values[end] == position->values[first])) {
      steps.push_back(t[end] - t[end - 1]);
      ++end;
    }
    found.shortest_position = std::min(found.shortest_position, t[end - 1] - t[first]);
  }
  if (steps.empty()) return found;
  found.typical = stats::upper_median(std::move(steps));
  found.shortest_position += found.typical;
  return found;
}

Recording reduced(const Recording& recording, double interval, std::size_t factor,
                  std::size_t reading) {
  DRIFT_DEMAND(interval > 0.0 && factor >= 1 && recording.rows() > 0);
  const std::vector<Joined> stretches = Cutter(recording, interval, factor).cut();
  const auto& t = recording.find("time")->values;
  Recording out;
  out.source = recording.source;
  out.facts = recording.facts;
  for (const Joined& s : stretches) {
    out.lines.push_back(recording.lines[s.end - 1]);
    // What a command or a position cuts off is shorter, and says less.
    out.begins.push_back(out.begins.empty() || s.position_begins ? t[s.first] - interval
                                                                 : t[s.first - 1]);
    out.samples.push_back(
        std::min(1.0, static_cast<double>(s.end - s.first) / static_cast<double>(factor)));
  }
  for (const Channel& c : recording.channels) {
    Channel reduced_channel{c.name, c.unit, {}};
    reduced_channel.values.reserve(stretches.size());
    const bool at_the_end = read_at_the_end(c.name);
    const bool covariate = is_covariate(c.name, RecordingKind::platform);
    for (const Joined& s : stretches) {
      // The rows the stretch spans, gaps in time counted; rows cut off by a command are no gap.
      const double expected = std::round((t[s.end - 1] - t[s.first]) / interval) + 1.0;
      reduced_channel.values.push_back(at_the_end ? c.values[s.end - 1]
                                       : covariate
                                           ? line_at_end(t, c.values, {s.first, s.end})
                                           : bridged_mean(t, c.values, s, interval, expected));
    }
    out.channels.push_back(std::move(reduced_channel));
  }
  if (reading > 0)
    take_angles_around(recording, stretches, {factor / reading, reading, interval}, out);
  return out;
}

}  // namespace drift
