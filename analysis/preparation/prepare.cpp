#include "analysis/preparation/prepare.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "analysis/preparation/fill_gaps.hpp"
#include "analysis/preparation/input_thresholds.hpp"
#include "analysis/preparation/plan_check.hpp"
#include "core/base/check.hpp"
#include "core/plan/timeline.hpp"
#include "core/recording/reduce.hpp"
#include "core/sim/measurements.hpp"

namespace drift::preparation {
namespace {

constexpr const char* sensors[] = {"acc_x",        "acc_y",         "acc_z",
                                   "gimbal_outer", "gimbal_middle", "gimbal_inner"};

std::string name_of(const Recording& r) {
  return r.source.empty() ? "recording" : r.source;
}

/// Runs of equal values that are far longer than the channel's usual ones become NaN.
void leave_out_stuck(Recording& r, std::vector<std::string>& remarks) {
  for (Channel& c : r.channels) {
    if (std::ranges::find(sensors, c.name) == std::end(sensors)) continue;
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
          "{}: {} stands still for {} samples, from line {} on: taken as a stuck sensor and "
          "left out",
          name_of(r), c.name, lost, line));
  }
}

void remark_missing(const Recording& r, const Readout& readout, std::vector<std::string>& remarks) {
  for (const char* name : sensors) {
    const bool wanted =
        std::string_view(name).starts_with("acc_") ? readout.accelerometers : readout.gimbals;
    if (!wanted) continue;
    const Channel* c = r.find(name);
    if (c == nullptr) {
      remarks.push_back(fmt::format("{}: no {}: what it would show is not seen", name_of(r), name));
      continue;
    }
    std::size_t missing = 0, longest = 0, run = 0, line = 0;
    for (std::size_t i = 0; i < c->values.size(); ++i) {
      run = std::isfinite(c->values[i]) ? 0 : run + 1;
      missing += run > 0 ? 1 : 0;
      if (run > longest) {
        longest = run;
        line = r.lines[i + 1 - run];
      }
    }
    if (missing == c->values.size())
      remarks.push_back(
          fmt::format("{}: {} is empty: what it would show is not seen", name_of(r), name));
    else if (missing > 0)
      remarks.push_back(
          fmt::format("{}: {} lacks {} of {} samples, {} of them in a row from line {} on",
                      name_of(r), name, missing, c->values.size(), longest, line));
  }
}

std::set<int> positions_of(const Recording& r) {
  std::set<int> all;
  if (const Channel* position = r.find("position"))
    for (const double p : position->values) all.insert(static_cast<int>(p));
  return all;
}

double plan_sample(const mc::Study& study) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Position& p : study.plan.positions) shortest = std::min(shortest, p.sample);
  return shortest;
}

/// By how much the samples of all recordings are to be put together; 0 and a complaint if they do
/// not fit the plan.
std::size_t factor_for(const std::vector<Recording>& recordings, double sample,
                       std::size_t most_rows, double& interval, std::vector<std::string>& wrong) {
  interval = std::numeric_limits<double>::quiet_NaN();
  std::size_t rows = 0;
  double shortest = std::numeric_limits<double>::infinity();
  for (const Recording& r : recordings) {
    const SampleIntervals found = sample_intervals(r);
    rows += r.rows();
    shortest = std::min(shortest, found.shortest_position);
    if (!std::isfinite(found.typical)) continue;
    if (std::isfinite(interval) &&
        std::abs(found.typical - interval) > RecordingLimits::interval_room * interval)
      wrong.push_back(fmt::format(
          "{}: samples {:.6g} s apart beside others {:.6g} s apart (expected recordings of one "
          "sample interval). Diagnose them apart",
          name_of(r), found.typical, interval));
    interval = found.typical;
  }
  if (!std::isfinite(interval)) return 1;
  const double ratio = sample / interval, whole = std::max(1.0, std::round(ratio));
  if (std::abs(ratio - whole) > RecordingLimits::interval_room * whole)
    wrong.push_back(fmt::format(
        "{}: samples are {:.6g} s apart, in the plan {:.6g} s (expected the plan's interval or a "
        "whole part of it). Is this the plan the recording was made with? Set plan.sample",
        name_of(recordings.front()), interval, sample));
  auto factor = static_cast<std::size_t>(whole);
  while (rows / factor > most_rows &&
         RecordingLimits::kept_samples * static_cast<double>(factor + 1) * interval <= shortest)
    ++factor;
  return factor;
}

}  // namespace

Prepared prepare(const mc::Study& study, const std::vector<Recording>& recordings,
                 std::size_t most_rows) {
  DRIFT_DEMAND(!recordings.empty());
  Prepared p{study, recordings, {}};
  std::vector<std::string> wrong;
  std::set<int> positions;
  for (Recording& r : p.recordings) {
    fill_gaps(r, sample_intervals(r).typical, p.remarks);
    leave_out_stuck(r, p.remarks);
    remark_missing(r, study.readout, p.remarks);
    positions.merge(positions_of(r));
  }
  const double sample = plan_sample(study);
  double interval = 0.0;
  const std::size_t factor = factor_for(p.recordings, sample, most_rows, interval, wrong);
  if (!wrong.empty()) throw InputError(ExitCode::recording, std::move(wrong));
  if (factor > 1) {
    std::size_t before = 0, after = 0;
    for (Recording& r : p.recordings) {
      before += r.rows();
      r = reduced(r, interval, factor);
      after += r.rows();
    }
    const double length = interval * static_cast<double>(factor);
    for (Position& position : p.study.plan.positions) position.sample = length;
    // Declared is the noise of the mean over the plan's interval; a longer mean has less.
    p.study.readout.accelerometer_noise *= std::sqrt(std::min(1.0, sample / length));
    p.remarks.push_back(
        fmt::format("{} rows {:.6g} s apart are taken as {} of {:.6g} s: means of accelerometers, "
                    "angles at the "
                    "end; effects faster than that are not looked for",
                    before, interval, after, length));
  }
  for (const Recording& r : p.recordings) {
    try {
      check_plan(p.study, r, p.remarks, wrong);
    } catch (const InputError& error) {
      wrong.insert(wrong.end(), error.messages().begin(), error.messages().end());
    }
    const Measurements m = measurements_of(r, p.study.readout);
    if (!m.acc.array().isFinite().any() && !m.gimbal.array().isFinite().any())
      wrong.push_back(fmt::format(
          "{}: nothing measured: every accelerometer and gimbal channel that [readout] asks for is "
          "absent, empty or stuck (expected at least one). Check the export",
          name_of(r)));
  }
  if (!wrong.empty()) throw InputError(ExitCode::recording, std::move(wrong));
  if (positions.size() < 2)
    p.remarks.emplace_back(
        "one position only: nothing can be held out, so no cause can be confirmed, and most causes "
        "look "
        "alike. Record more positions");
  std::vector<int> absent;
  for (int k = 1; k <= static_cast<int>(study.plan.positions.size()); ++k)
    if (!positions.contains(k)) absent.push_back(k);
  if (!absent.empty())
    p.remarks.push_back(
        fmt::format("positions {} of the plan are in no recording", fmt::join(absent, ", ")));
  return p;
}

}  // namespace drift::preparation
