#include "analysis/preparation/prepare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/preparation/clock_unit.hpp"
#include "analysis/preparation/covariates.hpp"
#include "analysis/preparation/covariates/own_columns.hpp"
#include "analysis/preparation/covariates/stepped_covariates.hpp"
#include "analysis/preparation/fillers.hpp"
#include "analysis/preparation/gimbal_branch.hpp"
#include "analysis/preparation/gimbal_zero.hpp"
#include "analysis/preparation/gravity_check.hpp"
#include "analysis/preparation/heading_zero.hpp"
#include "analysis/preparation/held_rows.hpp"
#include "analysis/preparation/own_names.hpp"
#include "analysis/preparation/plan_check.hpp"
#include "analysis/preparation/recorded_test.hpp"
#include "analysis/preparation/rounding_noise.hpp"
#include "analysis/preparation/rows/parts_of_one.hpp"
#include "analysis/preparation/rows/raw_spikes.hpp"
#include "analysis/preparation/rows/take_rows.hpp"
#include "core/base/check.hpp"
#include "core/plan/plan_rows.hpp"
#include "core/plan/shifted_numbers.hpp"
#include "core/plan/timeline.hpp"
#include "core/recording/instants/clock_leap.hpp"
#include "core/recording/rows/check_time.hpp"
#include "core/recording/rows/row_spacing.hpp"
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

std::vector<std::string> sources_of(const std::vector<Recording>& recordings) {
  std::vector<std::string> sources;
  for (const Recording& r : recordings) sources.push_back(r.source);
  return sources;
}

/// Refuses recordings of which something is wrong.
void refuse_if(std::vector<std::string> wrong, const Prepared& p) {
  if (wrong.empty()) return;
  correct_alone(wrong, p.study, sources_of(p.recordings));
  throw InputError(ExitCode::recording, std::move(wrong));
}

/// Of the first gimbal that is a constant off, or the heading; or "".
std::string off_zero_in(const Prepared& p) {
  for (const Recording& r : p.recordings)
    for (const auto off_zero : {gimbal_off_zero, heading_off_zero})
      if (std::string text = off_zero(p.study, r); !text.empty()) {
        std::vector<std::string> texts{in_own_names(std::move(text), p.study.recording)};
        correct_alone(texts, p.study, sources_of(p.recordings));
        return texts.front();
      }
  return "";
}

/// Whether the rows of a recording become fewer: finer than the plan's samples, or too many.
bool are_joined(const Prepared& p, const Recording& r, std::size_t most_rows) {
  std::size_t rows = 0;
  for (const Recording& each : p.recordings) rows += each.rows();
  if (rows > most_rows) return true;
  const std::vector<double> planned = planned_samples(r, p.study.plan);
  const std::vector<double> usual = row_spacing(r, planned).usual;
  for (std::size_t row = 0; row < r.rows(); ++row)
    if (1.5 * usual[row] < planned[row]) return true;
  return false;
}

}  // namespace

Prepared prepare(const mc::Study& study, const std::vector<Recording>& recordings,
                 std::size_t most_rows, Following following) {
  mc::require_own_terms(study);
  require_recordings(recordings);
  Prepared p{study, recordings, parts_of_one(recordings)};
  std::vector<std::string> wrong;
  std::set<int> positions;
  for (Recording& r : p.recordings) {
    number_rows(r, r.rows());
    leave_out_fillers(r, p.remarks);
    leave_out_held_rows(r, p.remarks);
    leave_out_stuck(r, p.remarks);
    if (std::string text = other_branch(r); !text.empty()) p.remarks.push_back(std::move(text));
    for (const std::string& text : {other_than_one_g(study, r), other_unit_of_time(r),
                                    in_own_names(shifted_numbers(r, study.plan), study.recording)})
      if (!text.empty()) wrong.push_back(text);
    if (std::string text = clock_leaps_text(r); !text.empty())
      wrong.push_back(fmt::format("{}: {}", name_of(r), text));
    remark_missing(r, study.readout, p.remarks);
    for (std::string& text : unmapped_temperature_of_terms(study, r))
      wrong.push_back(std::move(text));
    positions.merge(positions_of(r));
  }
  for (std::string& text : mistakes_of_own_columns(p.recordings, p.remarks))
    wrong.push_back(std::move(text));
  // As long as rows are those of the files.
  for (Recording& r : p.recordings)
    if (are_joined(p, r, most_rows)) leave_out_raw_spikes(r, p.remarks);
  const Rounding rounding = rounding_of(p.recordings);
  const std::vector<SteppedCovariate> stepped = stepped_covariates(p.recordings);
  std::vector<std::vector<ColumnGaps>> gaps;
  for (Recording& r : p.recordings)
    gaps.push_back(bridge_covariates(r, planned_samples(r, study.plan)));
  take_rows(p, most_rows, wrong);
  take_rounding(rounding, p.study.readout, p.remarks);
  take_smooth(stepped, p.recordings, p.remarks);
  refuse_if(wrong, p);
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
  refuse_if(wrong, p);
  for (Recording& r : p.recordings) {
    take_usual_branch(r);
    if (std::string text = gimbal_of_wrong_sign(p.study, r); !text.empty())
      wrong.push_back(in_own_names(std::move(text), study.recording));
  }
  refuse_if(wrong, p);
  p.off_zero = off_zero_in(p);
  if (positions.size() < 2)
    p.remarks.emplace_back(
        "one position only: nothing can be held out, so no cause can be confirmed, and most causes "
        "look alike. Record more positions");
  for (int k = 1; k <= static_cast<int>(study.plan.positions.size()); ++k)
    if (!positions.contains(k)) p.absent_positions.push_back(k);
  p.unused = leave_out_unknown(p.study, p.recordings, gaps, following, p.remarks);
  correct_alone(p.remarks, study, sources_of(p.recordings));
  return p;
}

}  // namespace drift::preparation
