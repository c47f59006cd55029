#include "core/recording/rows/join_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/check.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/rows/bridged_mean.hpp"
#include "core/recording/rows/line_at_end.hpp"

namespace drift {
namespace {

constexpr double long_enough = 0.7;   // of a joined row, to be left as it is
constexpr double largest_turn = 0.6;  // of a joined row in a slew [rad]

class Joiner {
 public:
  Joiner(const Recording& r, const RowSpacing& spacing, const JoinLimits& limits)
      : r_(r),
        spacing_(spacing),
        limits_(limits),
        time_(r.find("time")->values),
        position_(r.find("position")),
        phase_(r.find("phase")),
        heading_(r.find("case_heading")) {
    for (const Channel& c : r.channels)
      if (c.name.starts_with("cmd_")) commands_.push_back(&c);
  }

  /// The rows that become one, in order.
  std::vector<RowSpan> spans() const {
    std::vector<RowSpan> all;
    for (std::size_t first = 0; first < time_.size();) {
      std::size_t end = first + 1;
      while (end < time_.size() && goes_on(first, end)) ++end;
      divide({first, end}, all);
      first = end;
    }
    return all;
  }

  /// Angle by which the platform may turn against gravity in a span.
  double turned(const RowSpan& s) const {
    return (command(s.first) + detail::earth_rate) * (time_[s.end - 1] - r_.begins[s.first]);
  }

 private:
  bool goes_on(std::size_t first, std::size_t row) const {
    if (position_ && position_->values[row] != position_->values[row - 1]) return false;
    if (phase_ && phase_->values[row] != phase_->values[row - 1]) return false;
    if (r_.begins[row] != time_[row - 1]) return false;
    for (const Channel* c : commands_)
      if (!(std::abs(c->values[row] - c->values[first]) <= same_command)) return false;
    if (!heading_ || row < first + 2) return true;
    const auto& h = heading_->values;
    const double part = (time_[row] - time_[first]) / (time_[row - 1] - time_[first]);
    return std::abs(h[row] - h[first] - part * (h[row - 1] - h[first])) <= same_heading;
  }

  double command(std::size_t row) const {
    double square = 0.0;
    for (const Channel* c : commands_) square += c->values[row] * c->values[row];
    return std::sqrt(square);
  }

  /// Cuts a stretch of one command into joined rows.
  void divide(const RowSpan& stretch, std::vector<RowSpan>& out) const {
    double length = limits_.length * limits_.planned[stretch.first];
    if (phase_ && phase_->values[stretch.first] == 1.0)
      length = std::min(length, largest_turn / (command(stretch.first) + detail::earth_rate));
    const double origin = r_.begins[stretch.first];
    const double lasts = time_[stretch.end - 1] - origin;
    const double part = lasts / std::max(1.0, std::round(lasts / length));
    const auto bin = [&](std::size_t row) {
      return std::floor((time_[row] - origin - 0.5 * spacing_.usual[row]) / part);
    };
    for (std::size_t row = stretch.first; row < stretch.end; ++row) {
      const bool alone = !(spacing_.usual[row] < long_enough * length);
      if (row == stretch.first || alone || bin(row) != bin(row - 1))
        out.push_back({row, row + 1});
      else
        out.back().end = row + 1;
    }
  }

  const Recording& r_;
  const RowSpacing& spacing_;
  const JoinLimits& limits_;
  const std::vector<double>& time_;
  const Channel* position_;
  const Channel* phase_;
  const Channel* heading_;
  std::vector<const Channel*> commands_;
};

/// Of the rows that are there, weighted by time.
double mean_of(const std::vector<double>& values, const RowSpan& s, const Recording& r,
               const std::vector<double>& time) {
  if (s.end == s.first + 1) return values[s.first];
  double sum = 0.0, measured = 0.0;
  for (std::size_t row = s.first; row < s.end; ++row) {
    if (!std::isfinite(values[row])) continue;
    sum += (time[row] - r.begins[row]) * values[row];
    measured += time[row] - r.begins[row];
  }
  return measured > 0.0 ? sum / measured : nan_value;
}

}  // namespace

Recording joined_rows(const Recording& recording, const RowSpacing& spacing,
                      const JoinLimits& limits) {
  DRIFT_EXPECTS(recording.begins.size() == recording.rows() && limits.length > 0.0 &&
                limits.planned.size() == recording.rows());
  const Joiner joiner(recording, spacing, limits);
  const std::vector<RowSpan> spans = joiner.spans();
  const auto& time = recording.find("time")->values;
  Recording out;
  out.source = recording.source;
  out.facts = recording.facts;
  for (const RowSpan& s : spans) {
    const double begin = recording.begins[s.first], length = time[s.end - 1] - begin;
    out.lines.push_back(recording.lines[s.end - 1]);
    out.begins.push_back(begin);
    out.samples.push_back(length / limits.planned[s.first]);
  }
  for (const Channel& c : recording.channels) {
    Channel joined{c.name, c.unit, {}};
    joined.values.reserve(spans.size());
    const bool at_the_end = read_at_the_end(c.name);
    const bool covariate = is_covariate(c.name, RecordingKind::platform);
    const bool accelerometer = c.name.starts_with("acc_");
    for (std::size_t k = 0; k < spans.size(); ++k) {
      const RowSpan& s = spans[k];
      if (at_the_end) {
        joined.values.push_back(c.values[s.end - 1]);
      } else if (covariate) {
        joined.values.push_back(line_at_end(time, c.values, s));
      } else if (accelerometer && s.end > s.first + 1) {
        const BridgedMean mean =
            bridged_mean(recording.begins, time, c.values, s, joiner.turned(s));
        joined.values.push_back(mean.value);
        // Three axes share one weight: that of the least measured.
        if (std::isfinite(mean.value))
          out.samples[k] = std::min(out.samples[k], mean.seconds / limits.planned[s.first]);
      } else {
        joined.values.push_back(mean_of(c.values, s, recording, time));
      }
    }
    out.channels.push_back(std::move(joined));
  }
  return out;
}

}  // namespace drift
