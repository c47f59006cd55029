#include "analysis/preparation/lost_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "analysis/preparation/command_change.hpp"
#include "analysis/preparation/input_thresholds.hpp"
#include "core/plan/case_heading.hpp"
#include "core/plan/plan_rows.hpp"
#include "core/recording/recording_channels.hpp"

namespace drift::preparation {
namespace {

/// What a gap in front of a row turns out to be.
struct Gap {
  double change = nan_value;  ///< when the command changed; NaN: it did not, or at the last row
};

class Gaps {
 public:
  Gaps(const Recording& r, const TestPlan& plan, const RowSpacing& spacing)
      : r_(r),
        plan_(plan),
        spacing_(spacing),
        time_(r.find("time")->values),
        position_(r.find("position")->values),
        phase_(r.find("phase")) {}

  bool position_begins(std::size_t row) const {
    return row == 0 || position_[row] != position_[row - 1];
  }
  bool caged(std::size_t row) const {
    if (!position_begins(row)) return false;
    return row == 0 || !planned(row) || planned(row)->entry == Entry::caged;
  }

  /// When a row begins that is not carried on from the one before: one usual step earlier, or with
  /// the dwell of the plan where the first rows of the position are missing and the last are not,
  /// or both are and the dwell is what lies between its neighbours.
  double begin_of_caged(std::size_t row) const {
    const Position* p = planned(row);
    double usual = spacing_.usual[row];
    // The plan's sample, where jitter hides the difference.
    if (p && !(std::abs(usual - p->sample) > RecordingLimits::hidden * spacing_.jitter))
      usual = p->sample;
    const double begin = time_[row] - usual;
    const double before = row > 0 ? time_[row - 1] : -std::numeric_limits<double>::infinity();
    if (p && !(phase_ && phase_->values[row] == 1.0)) {
      const std::size_t last = last_of(row);
      const double by_plan = time_[last] - p->dwell, earlier = (begin - by_plan) / usual;
      if (std::abs(by_plan - ended_before(row)) < RecordingLimits::grid_room * usual)
        return std::max(by_plan, before);  // however long the first row is
      if (last + 1 < time_.size() ? spacing_.gap(last + 1) : row == 0) {
        // Its end is missing, or may be: what is between the position before and the one behind is
        // the dwell, or nobody knows.
        const bool fills = row > 0 && last + 1 < time_.size() && caged(last + 1) &&
                           std::abs(ended_before(row) + p->dwell - begin_of_caged(last + 1)) <
                               RecordingLimits::grid_room * usual;
        return std::max(fills ? ended_before(row) : begin, before);
      }
      const bool whole = std::abs(earlier - std::round(earlier)) < RecordingLimits::grid_room;
      const bool few = earlier > 0.5 && earlier < RecordingLimits::first_rows + 0.5;
      if (whole && few && by_plan > before - RecordingLimits::grid_room * usual)
        return std::max(by_plan, before);
    }
    return std::max(begin, before);
  }

  /// Whether the first row of a caged position is longer than is usual.
  bool begins_long(std::size_t row) const {
    return RowSpacing::lost_within(time_[row] - begin_of_caged(row), spacing_.usual[row]);
  }

  /// [s] How long the rows of a position last whose first one is as long as is usual.
  double by_its_rows(std::size_t row) const {
    return time_[last_of(row)] - time_[row] + spacing_.usual[row];
  }

  /// The same, or the first ones are missing: the dwell began where the one before ended.
  bool began_earlier(std::size_t row) const {
    return begins_long(row) && std::abs(begin_of_caged(row) - ended_before(row)) <
                                   RecordingLimits::grid_room * spacing_.usual[row];
  }

  /// Whether the jitter of the rows around is more than accelerometers can bear at a row that
  /// begins at an unknown instant.
  bool begins_uncertain(std::size_t row, const Readout& readout) const {
    const Position* p = planned(row);
    if (!p || !(spacing_.jitter > 0.0)) return false;
    const double noise =
        readout.accelerometer_noise * std::sqrt(std::max(1.0, p->sample / spacing_.usual[row]));
    return 0.5 * detail::earth_rate * spacing_.jitter > RecordingLimits::begin_noise * noise;
  }

  /// A row or more is missing in front of this one, to which the attitude is carried along.
  bool lost_before(std::size_t row, const Site& site) const {
    if (spacing_.gap(row)) return true;
    if (same_command(row)) return false;
    const CommandChange found = command_change(r_, site, row, spacing_);
    if (spacing_.longer(row)) return found.why_not.empty() && found.time > time_[row - 1];
    // A short one among unequal rows is no gap by its length, but the platform turned in it: by
    // more than part of a usual row, and than drift.
    const double finest = std::min(spacing_.usual[row - 1], spacing_.usual[row]);
    return found.as_recorded > RecordingLimits::change_room * finest * command_step(row) &&
           found.as_recorded > PlanLimits::drifted * (time_[row] - time_[row - 1]);
  }

  /// Looks at the gap in front of a row. Empty and a message if it cannot be closed.
  std::optional<Gap> close(std::size_t row, const Site& site,
                           std::vector<std::string>& wrong) const {
    const auto refuse = [&](const std::string& why) {
      wrong.push_back(
          fmt::format("{}:{}: about {:.0f} rows are missing before this one, and {} (expected rows "
                      "wherever the command changes, for the attitude is carried along). Give the "
                      "missing rows, or mark the position as caged",
                      r_.source.empty() ? "recording" : r_.source,
                      row < r_.lines.size() ? r_.lines[row] : row + 1, spacing_.missing(row), why));
      return std::nullopt;
    };
    const auto dwells = [&](std::size_t k) { return !phase_ || phase_->values[k] == 0.0; };
    if (position_begins(row) && dwells(row - 1) && dwells(row))
      return refuse("with them the whole way from one position to the next");
    if (same_command(row)) return Gap{};
    if (!r_.find("cmd_x")) return refuse("there are no commands");
    const CommandChange found = command_change(r_, site, row, spacing_);
    if (!found.why_not.empty()) return refuse(found.why_not);
    return found.time > time_[row - 1] ? Gap{found.time} : Gap{};
  }

 private:
  /// The last row of the position of a row.
  std::size_t last_of(std::size_t row) const {
    while (row + 1 < time_.size() && position_[row + 1] == position_[row]) ++row;
    return row;
  }
  /// When the position before ended; a test begins at 0.
  double ended_before(std::size_t row) const { return row > 0 ? time_[row - 1] : 0.0; }
  const Position* planned(std::size_t row) const { return planned_position(plan_, position_[row]); }
  bool same_command(std::size_t row) const {
    return command_step(row) < RecordingLimits::gap_command;
  }
  /// [rad/s] by which the command differs from that of the row before.
  double command_step(std::size_t row) const {
    double squares = 0.0;
    for (const std::string_view name : command_channels.names)
      if (const Channel* c = r_.find(name))
        squares += std::pow(c->values[row] - c->values[row - 1], 2);
    return std::sqrt(squares);
  }

  const Recording& r_;
  const TestPlan& plan_;
  const RowSpacing& spacing_;
  const std::vector<double>& time_;
  const std::vector<double>& position_;
  const Channel* phase_;
};

bool is_accelerometer(const Channel& c) {
  return c.name.starts_with("acc_");
}

/// A row at an instant between two others at which the command changed: not measured, the command
/// that was before; the case turned on the way, if it did.
void insert_row(Spaced& s, std::size_t row, double t) {
  auto& time = *std::ranges::find(s.recording.channels, "time", &Channel::name);
  const double t0 = time.values[row - 1], t1 = time.values[row];
  const auto at = static_cast<std::ptrdiff_t>(row);
  const auto value = [&](const char* name, std::size_t k) {
    const Channel* c = s.recording.find(name);
    return c ? c->values[k] : 0.0;
  };
  const bool turning = value("case_heading", row) != value("case_heading", row - 1);
  for (Channel& c : s.recording.channels) {
    const double a = c.values[row - 1], b = c.values[row];
    const bool held = c.name.starts_with("cmd_") || c.name.starts_with("loop_");
    const bool named = c.name == "position" || c.name == "phase" || c.name == "case_heading";
    const double x = is_accelerometer(c) || c.name.starts_with("gimbal_") ? nan_value
                     : held                                               ? a
                     : named                                              ? (turning ? b : a)
                             : a + (b - a) * (t - t0) / (t1 - t0);
    c.values.insert(c.values.begin() + at, x);
  }
  s.recording.lines.insert(s.recording.lines.begin() + at, s.recording.lines[row]);
  s.spacing.step[row] = t1 - t;
  s.spacing.step.insert(s.spacing.step.begin() + at, t - t0);
  s.spacing.usual.insert(s.spacing.usual.begin() + at, s.spacing.usual[row - 1]);
}

}  // namespace

Spaced with_begins(const Recording& recording, const mc::Study& study,
                   std::vector<std::string>& remarks, std::vector<std::string>& wrong) {
  Spaced out{recording, row_spacing(recording, planned_samples(recording, study.plan))};
  const Gaps gaps(recording, study.plan, out.spacing);
  const RowSpacing spacing = out.spacing;
  const std::size_t n = recording.rows();
  std::vector<std::pair<std::size_t, double>> changes;
  std::vector<double> begins(n);
  double missing = 0.0;
  std::size_t count = 0, first = 0, caged = 0, longer = 0;
  double least = std::numeric_limits<double>::infinity(), most = 0.0;  // [s] of those by their rows
  const auto not_measured = [&](std::size_t row) {
    for (Channel& c : out.recording.channels)
      if (is_accelerometer(c)) c.values[row] = nan_value;
  };
  for (std::size_t row = 0; row < n; ++row) {
    if (gaps.caged(row)) {
      begins[row] = gaps.begin_of_caged(row);
      ++caged;
      const bool long_row = gaps.begins_long(row);
      if (long_row) {
        ++longer;
        least = std::min(least, gaps.by_its_rows(row));
        most = std::max(most, gaps.by_its_rows(row));
      }
      if (gaps.begins_uncertain(row, study.readout) || long_row) not_measured(row);
      continue;
    }
    begins[row] = recording.find("time")->values[row - 1];
    if (!gaps.lost_before(row, study.site)) continue;
    missing += spacing.missing(row);
    if (count++ == 0) first = row;
    not_measured(row);
    if (const auto gap = gaps.close(row, study.site, wrong); gap && std::isfinite(gap->change))
      changes.emplace_back(row, gap->change);
  }
  out.recording.begins = std::move(begins);
  for (std::size_t k = changes.size(); k-- > 0;) {
    const auto [row, t] = changes[k];
    out.recording.begins.insert(out.recording.begins.begin() + static_cast<std::ptrdiff_t>(row),
                                out.recording.begins[row]);
    out.recording.begins[row + 1] = t;
    insert_row(out, row, t);
  }
  const std::string name = recording.source.empty() ? "recording" : recording.source;
  if (longer > 0)
    remarks.push_back(fmt::format(
        "{}: the first row of {} caged position{} is longer than is usual, by the dwell of the "
        "plan, or rows are missing before it: its accelerometers are taken as not measured{}",
        name, longer, longer == 1 ? "" : "s",
        longer > 1 && longer + 1 >= caged &&  // all of them: of the first one nobody can know
                most - least < RecordingLimits::grid_room * out.spacing.usual.front()
            ? fmt::format(" (if the platform was caged up to the usual step before it, the dwell "
                          "is {:.6g} min, and plan.dwell is to say so)",
                          most / unit::minute.to_si)
            : ""));
  if (count > 0)
    remarks.push_back(fmt::format(
        "{}: {:.0f} {} missing within positions, in {} gap{}, the first before line {}: the "
        "command is taken as held, the accelerometers right behind a gap as not measured{}",
        name, missing, missing == 1.0 ? "row is" : "rows are", count, count == 1 ? "" : "s",
        first < recording.lines.size() ? recording.lines[first] : first + 1,
        changes.empty() ? ""
                        : fmt::format("; in {} of them the command changed, when is read off the "
                                      "gimbal angles",
                                      changes.size())));
  return out;
}

bool rows_missing(const Recording& recording, const TestPlan& plan) {
  const RowSpacing spacing = row_spacing(recording, planned_samples(recording, plan));
  const Gaps gaps(recording, plan, spacing);
  for (std::size_t row = 0; row < recording.rows(); ++row)
    if (gaps.caged(row) ? gaps.began_earlier(row) : spacing.gap(row)) return true;
  return false;
}

}  // namespace drift::preparation
