#include "analysis/preparation/rows/take_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "analysis/preparation/gimbals_behind_gaps.hpp"
#include "analysis/preparation/input_thresholds.hpp"
#include "analysis/preparation/lost_rows.hpp"
#include "core/base/nan.hpp"
#include "core/plan/plan_rows.hpp"
#include "core/recording/rows/join_rows.hpp"
#include "core/recording/rows/reduce.hpp"

namespace drift::preparation {
namespace {

/// The plan's one sample of all rows [s]; NaN if their positions have several.
double common_sample(const mc::Study& study, std::span<const Recording> recordings) {
  double common = nan_value;
  for (const Recording& r : recordings)
    for (const double sample : planned_samples(r, study.plan)) {
      if (std::isfinite(common) && sample != common) return nan_value;
      common = sample;
    }
  return common;
}

/// What of a study's recordings is being made ready.
struct RowWork {
  Prepared& p;
  double sample = 0.0;  ///< of the plan [s]; NaN: positions have several
  std::size_t most_rows = 0;
  std::vector<std::string>& wrong;
};

/// Whether its rows have one distance, none of them missing.
bool is_even(const mc::Study& study, const Recording& r) {
  return row_spacing(r, planned_samples(r, study.plan)).regular && !rows_missing(r, study.plan);
}

/// The one interval of all recordings; NaN if rows lie at other distances, in any of them.
double common_interval(const mc::Study& study, const std::vector<Recording>& recordings) {
  double common = nan_value;
  for (const Recording& r : recordings) {
    if (!is_even(study, r)) return nan_value;
    const double interval = sample_intervals(r).typical;
    if (!std::isfinite(interval)) continue;
    if (std::isfinite(common) &&
        std::abs(interval - common) > RecordingLimits::same_interval * common)
      return nan_value;
    common = interval;
  }
  return common;
}

/// Rows of the recording that become a sample of the plan.
double rows_in(double sample, double interval) {
  return std::max(1.0, std::round(sample / interval));
}

/// Holds the evenly spaced rows of each recording against the plan, as if it were alone: whatever
/// the others' intervals are, each of its rows is taken as one of the plan's samples or a part.
/// False, with a complaint, where they do not fit.
bool fits_the_plan(const RowWork& work, const Recording& r) {
  const double interval = sample_intervals(r).typical,
               sample = common_sample(work.p.study, std::span(&r, 1));
  if (!is_even(work.p.study, r) || !std::isfinite(interval) || !std::isfinite(sample)) return true;
  const double whole = rows_in(sample, interval);
  const std::string name = r.source.empty() ? "recording" : r.source;
  if (std::abs(sample / interval - whole) > RecordingLimits::interval_room * whole) {
    work.wrong.push_back(fmt::format(
        "{}: samples are {:.6g} s apart, in the plan {:.6g} s (expected the plan's interval or a "
        "whole part of it). Is this the plan the recording was made with? Set plan.sample",
        name, interval, sample));
    return false;
  }
  const double off = interval * whole / sample - 1.0;
  if (std::abs(off) > RecordingLimits::interval_said)
    work.p.remarks.push_back(fmt::format(
        "{}: samples are {:.6g} s apart, in the plan {:.6g} s: {:.2g} % {}. The recording's own "
        "times are used; if its clock is off, every rate is by as much, else set plan.sample{}",
        name, interval * whole, sample, 100.0 * std::abs(off), off > 0.0 ? "longer" : "shorter",
        work.p.recordings.size() > 1 ? ", which is that of all recordings" : ""));
  return true;
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

/// By how much evenly spaced samples are to be put together.
Factors factors_for(const RowWork& work, double interval) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Recording& r : work.p.recordings)
    shortest = std::min(shortest, sample_intervals(r).shortest_position);
  const auto sample = static_cast<std::size_t>(rows_in(work.sample, interval));
  std::size_t factor = sample;
  while (rows_of(work.p.recordings) / factor > work.most_rows &&
         RecordingLimits::kept_samples * static_cast<double>(factor + sample) * interval <=
             shortest)
    factor += sample;
  return {sample, factor};
}

/// Evenly spaced rows: a whole number of them becomes one.
void take_even_rows(const RowWork& work, double interval) {
  const auto [sample, factor] = factors_for(work, interval);
  if (factor == 1) return;
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
void take_uneven_rows(const RowWork& work) {
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

void take_rows(Prepared& p, std::size_t most_rows, std::vector<std::string>& wrong) {
  const RowWork work{p, common_sample(p.study, p.recordings), most_rows, wrong};
  bool fit = true;
  for (const Recording& r : p.recordings) fit = fits_the_plan(work, r) && fit;
  if (!fit) return;
  const double interval = common_interval(p.study, p.recordings);
  if (!std::isfinite(interval) || !std::isfinite(work.sample)) {
    if (rows_of(p.recordings) > p.recordings.size()) take_uneven_rows(work);
  } else if (wrong.empty()) {
    take_even_rows(work, interval);
  }
}

}  // namespace drift::preparation
