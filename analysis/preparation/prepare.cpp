#include "analysis/preparation/prepare.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "analysis/preparation/clock_unit.hpp"
#include "analysis/preparation/covariates.hpp"
#include "analysis/preparation/covariates/own_columns.hpp"
#include "analysis/preparation/covariates/stepped_covariates.hpp"
#include "analysis/preparation/fillers.hpp"
#include "analysis/preparation/gimbal_branch.hpp"
#include "analysis/preparation/gimbal_zero.hpp"
#include "analysis/preparation/gimbals_behind_gaps.hpp"
#include "analysis/preparation/gravity_check.hpp"
#include "analysis/preparation/heading_zero.hpp"
#include "analysis/preparation/held_rows.hpp"
#include "analysis/preparation/input_thresholds.hpp"
#include "analysis/preparation/lost_rows.hpp"
#include "analysis/preparation/own_names.hpp"
#include "analysis/preparation/plan_check.hpp"
#include "analysis/preparation/recorded_test.hpp"
#include "analysis/preparation/rounding_noise.hpp"
#include "core/base/check.hpp"
#include "core/plan/plan_rows.hpp"
#include "core/plan/shifted_numbers.hpp"
#include "core/plan/timeline.hpp"
#include "core/recording/rows/check_time.hpp"
#include "core/recording/rows/join_rows.hpp"
#include "core/recording/rows/reduce.hpp"
#include "core/sim/measurements.hpp"
#include "mc/study/own_terms_check.hpp"

namespace drift::preparation {
namespace {

constexpr const char* sensors[] = {"acc_x",        "acc_y",         "acc_z",
                                   "gimbal_outer", "gimbal_middle", "gimbal_inner"};

std::string name_of(const Recording& r) {
  return r.source.empty() ? "recording" : r.source;
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

/// The plan's one sample of all rows [s]; NaN if their positions have several.
double common_sample(const mc::Study& study, const std::vector<Recording>& recordings) {
  double common = nan_value;
  for (const Recording& r : recordings)
    for (const double sample : planned_samples(r, study.plan)) {
      if (std::isfinite(common) && sample != common) return nan_value;
      common = sample;
    }
  return common;
}

/// What of a study's recordings is being made ready.
struct Work {
  Prepared& p;
  double sample = 0.0;  ///< of the plan [s]; NaN: positions have several
  std::size_t most_rows = 0;
  std::vector<std::string>& wrong;
};

/// The one interval of all recordings; NaN if rows lie at other distances, in any of them.
double common_interval(const mc::Study& study, const std::vector<Recording>& recordings) {
  double common = nan_value;
  for (const Recording& r : recordings) {
    const double interval = sample_intervals(r).typical;
    if (!row_spacing(r, planned_samples(r, study.plan)).regular || rows_missing(r, study.plan))
      return nan_value;
    if (!std::isfinite(interval)) continue;
    if (std::isfinite(common) &&
        std::abs(interval - common) > RecordingLimits::same_interval * common)
      return nan_value;
    common = interval;
  }
  return common;
}

std::size_t rows_of(const std::vector<Recording>& recordings) {
  std::size_t rows = 0;
  for (const Recording& r : recordings) rows += r.rows();
  return rows;
}

/// Rows that become a sample of the plan, and rows that become one row: as many such samples.
struct Factors {
  std::size_t sample = 1, row = 1;
};

/// By how much evenly spaced samples are to be put together; a complaint if they do not fit the
/// plan.
Factors factors_for(const Work& work, double interval) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Recording& r : work.p.recordings)
    shortest = std::min(shortest, sample_intervals(r).shortest_position);
  const double ratio = work.sample / interval, whole = std::max(1.0, std::round(ratio));
  if (std::abs(ratio - whole) > RecordingLimits::interval_room * whole)
    work.wrong.push_back(fmt::format(
        "{}: samples are {:.6g} s apart, in the plan {:.6g} s (expected the plan's interval or a "
        "whole part of it). Is this the plan the recording was made with? Set plan.sample",
        name_of(work.p.recordings.front()), interval, work.sample));
  else if (const double off = interval * whole / work.sample - 1.0;
           std::abs(off) > RecordingLimits::interval_said)
    work.p.remarks.push_back(fmt::format(
        "{}: samples are {:.6g} s apart, in the plan {:.6g} s: {:.2g} % {}. The recording's own "
        "times are used; if its clock is off, every rate is by as much, else set plan.sample",
        name_of(work.p.recordings.front()), interval * whole, work.sample, 100.0 * std::abs(off),
        off > 0.0 ? "longer" : "shorter"));
  const auto sample = static_cast<std::size_t>(whole);
  std::size_t factor = sample;
  while (rows_of(work.p.recordings) / factor > work.most_rows &&
         RecordingLimits::kept_samples * static_cast<double>(factor + sample) * interval <=
             shortest)
    factor += sample;
  return {sample, factor};
}

/// Evenly spaced rows: a whole number of them becomes one.
void take_even_rows(const Work& work, double interval) {
  const auto [sample, factor] = factors_for(work, interval);
  if (!work.wrong.empty() || factor == 1) return;
  Prepared& p = work.p;
  const std::size_t before = rows_of(p.recordings);
  // [readout] declares the noise of one sample of the plan, which has one reading of each angle.
  for (Recording& r : p.recordings) r = reduced(r, interval, factor, factor > sample ? sample : 0);
  const double length = interval * static_cast<double>(factor);
  for (Position& position : p.study.plan.positions) position.sample = length;
  // Declared is the noise of the mean over the plan's interval; a longer mean has less.
  p.study.readout.accelerometer_noise *= std::sqrt(std::min(1.0, work.sample / length));
  p.remarks.push_back(
      fmt::format("{} rows {:.6g} s apart are taken as {} of {:.6g} s: means of accelerometers, "
                  "angles {} the end; effects faster than that are not looked for",
                  before, interval, rows_of(p.recordings), length,
                  p.recordings.front().readings.empty() ? "at" : "by the readings around"));
}

/// Rows at any distance: each has its own interval, fine ones are joined.
void take_uneven_rows(const Work& work) {
  Prepared& p = work.p;
  std::vector<Spaced> all;
  for (const Recording& r : p.recordings) {
    std::vector<std::string> gaps;
    all.push_back(with_begins(r, p.study, p.remarks, gaps));
    if (gaps.size() >= RecordingLimits::odd_gaps)
      if (const std::string text = gimbals_behind_gaps(r, p.study); !text.empty()) gaps = {text};
    work.wrong.insert(work.wrong.end(), gaps.begin(), gaps.end());
  }
  if (!work.wrong.empty()) return;
  const std::size_t before = rows_of(p.recordings);
  double length = 1.0, longest = 0.0;  // of a joined row [samples of the plan], [s]
  const auto join = [&] {
    for (std::size_t k = 0; k < all.size(); ++k) {
      const JoinLimits limits{length, planned_samples(all[k].recording, p.study.plan)};
      for (const double sample : limits.planned) longest = std::max(longest, length * sample);
      p.recordings[k] = joined_rows(all[k].recording, all[k].spacing, limits);
    }
    return rows_of(p.recordings);
  };
  std::size_t now = join();
  while (now > work.most_rows) {
    length *= RecordingLimits::coarser;
    const std::size_t fewer = join();
    if (fewer == now) break;  // stretches of one row each
    now = fewer;
  }
  if (now < before)
    p.remarks.push_back(fmt::format(
        "{} rows at several distances are taken as {} of up to {:.6g} s: means of accelerometers, "
        "angles at the end; effects faster than that are not looked for",
        before, now, longest));
}

}  // namespace

Prepared prepare(const mc::Study& study, const std::vector<Recording>& recordings,
                 std::size_t most_rows, Following following) {
  mc::require_own_terms(study);
  require_recordings(recordings);
  Prepared p{study, recordings, {}};
  std::vector<std::string> wrong;
  std::set<int> positions;
  for (Recording& r : p.recordings) {
    number_rows(r, r.rows());
    leave_out_fillers(r, p.remarks);
    leave_out_held_rows(r, p.remarks);
    leave_out_stuck(r, p.remarks);
    if (std::string text = other_branch(r); !text.empty()) p.remarks.push_back(std::move(text));
    for (const std::string& text :
         {other_than_one_g(study, r), other_unit_of_time(r), shifted_numbers(r, study.plan)})
      if (!text.empty()) wrong.push_back(text);
    remark_missing(r, study.readout, p.remarks);
    for (std::string& text : unmapped_temperature_of_terms(study, r))
      wrong.push_back(std::move(text));
    positions.merge(positions_of(r));
  }
  for (std::string& text : mistakes_of_own_columns(p.recordings, p.remarks))
    wrong.push_back(std::move(text));
  // As long as rows are those of the files.
  const Rounding rounding = rounding_of(p.recordings);
  const std::vector<SteppedCovariate> stepped = stepped_covariates(p.recordings);
  std::vector<std::vector<ColumnGaps>> gaps;
  for (Recording& r : p.recordings)
    gaps.push_back(bridge_covariates(r, planned_samples(r, study.plan)));
  const Work work{p, common_sample(study, p.recordings), most_rows, wrong};
  const double interval = common_interval(study, p.recordings);
  if (std::isfinite(interval) && std::isfinite(work.sample))
    take_even_rows(work, interval);
  else if (rows_of(p.recordings) > p.recordings.size())
    take_uneven_rows(work);
  take_rounding(rounding, p.study.readout, p.remarks);
  take_smooth(stepped, p.recordings, p.remarks);
  if (!wrong.empty()) throw InputError(ExitCode::recording, std::move(wrong));
  for (const Recording& r : p.recordings) {
    try {
      check_plan(p.study, r, p.remarks, wrong);
    } catch (const InputError& error) {
      for (const std::string& message : error.messages())
        wrong.push_back(in_own_names(message, study.recording));
    }
    const Measurements m = measurements_of(r, p.study.readout);
    if (!m.acc.array().isFinite().any() && !m.gimbal.array().isFinite().any())
      wrong.push_back(fmt::format(
          "{}: nothing measured: every accelerometer and gimbal channel that [readout] asks for is "
          "absent, empty or stuck (expected at least one). Check the export",
          name_of(r)));
  }
  if (!wrong.empty()) throw InputError(ExitCode::recording, std::move(wrong));
  for (Recording& r : p.recordings) {
    take_usual_branch(r);
    if (std::string text = gimbal_of_wrong_sign(p.study, r); !text.empty())
      wrong.push_back(in_own_names(std::move(text), study.recording));
  }
  if (!wrong.empty()) throw InputError(ExitCode::recording, std::move(wrong));
  for (const Recording& r : p.recordings)
    for (const auto off_zero : {gimbal_off_zero, heading_off_zero})
      if (p.off_zero.empty()) p.off_zero = in_own_names(off_zero(p.study, r), study.recording);
  if (positions.size() < 2)
    p.remarks.emplace_back(
        "one position only: nothing can be held out, so no cause can be confirmed, and most causes "
        "look alike. Record more positions");
  for (int k = 1; k <= static_cast<int>(study.plan.positions.size()); ++k)
    if (!positions.contains(k)) p.absent_positions.push_back(k);
  p.unused = leave_out_unknown(p.study, p.recordings, gaps, following, p.remarks);
  return p;
}

}  // namespace drift::preparation
