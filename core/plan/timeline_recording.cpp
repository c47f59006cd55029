#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/check.hpp"
#include "core/base/memory.hpp"
#include "core/physics/gimbals.hpp"
#include "core/physics/own/own_terms.hpp"
#include "core/plan/attitude_check.hpp"
#include "core/plan/case_heading.hpp"
#include "core/plan/celsius_column.hpp"
#include "core/plan/plan_memory.hpp"
#include "core/plan/timeline.hpp"
#include "core/recording/recording_channels.hpp"
#include "core/recording/recording_problems.hpp"
#include "core/recording/rows/count_positions.hpp"
#include "core/recording/rows/row_spacing.hpp"

namespace drift {
namespace {

/// Walks the rows of a recording and turns them into intervals; collects what does not fit.
class Reader {
 public:
  Reader(const Recording& recording, const TestPlan& plan, const Site& site)
      : rec_(recording),
        plan_(plan),
        site_(site),
        passages_(plan_passages(plan, site)),
        problems_(recording.source.empty() ? "recording" : recording.source) {
    heading_ = rec_.find("case_heading");
    phase_ = rec_.find("phase");
    for (int a = 0; a < 3; ++a) cmd_[a] = rec_.find(std::string("cmd_") + "xyz"[a]);
    for (std::size_t a = 0; a < loop_.size(); ++a) loop_[a] = rec_.find(loop_channels[a]);
  }

  Timeline read() {
    timeline_.site = site_;
    timeline_.positions = static_cast<int>(plan_.positions.size());
    check_count();
    problems_.throw_if_any();
    check_positions();
    problems_.throw_if_any();
    for (std::size_t row = 0; row < rec_.rows(); ++row) add(row);
    problems_.throw_if_any();
    tell_loop();
    place_nodes(timeline_, chain_start_);
    take_covariates();
    for (const RowMistake& m : attitude_mistakes(rec_, plan_, timeline_)) complain(m.row, m.text);
    problems_.throw_if_any();
    return std::move(timeline_);
  }

 private:
  void complain(std::size_t row, const std::string& what) {
    problems_.add_in_line(row < rec_.lines.size() ? rec_.lines[row] : row + 1, what);
  }

  /// Positions that were counted must be those of the plan: else every number may be another's.
  void check_count() {
    const auto counted = std::ranges::find(rec_.facts, positions_counted,
                                           &std::pair<std::string, std::string>::first);
    if (counted == rec_.facts.end() || counted->second == fmt::format("{}", plan_.positions.size()))
      return;
    complain(0, fmt::format("no column tells the positions, and {} counted where the platform "
                            "stands between turns (expected the {} of the plan). Add a column "
                            "position, or take the plan that the recording was made with",
                            counted->second == "1" ? "1 is" : counted->second + " are",
                            plan_.positions.size()));
  }

  /// Positions that the plan does not have, all in one message.
  void check_positions() {
    const auto& numbers = rec_.find("position")->values;
    const auto planned = static_cast<double>(plan_.positions.size());
    std::vector<double> others;
    std::size_t first = 0, rows = 0;
    for (std::size_t row = 0; row < numbers.size(); ++row) {
      if (numbers[row] >= 1.0 && numbers[row] <= planned) continue;
      if (rows++ == 0) first = row;
      if (std::ranges::find(others, numbers[row]) == others.end()) others.push_back(numbers[row]);
    }
    if (rows == 0) return;
    constexpr std::size_t most = 8;
    const std::string more =
        others.size() > most ? fmt::format(" and {} more", others.size() - most) : "";
    const bool several = others.size() > 1;
    others.resize(std::min(most, others.size()));
    complain(first, fmt::format("position{} {}{} {} not in the plan, in {} rows from here on "
                                "(expected positions 1 to {}). Use the plan "
                                "the recording was made with; where it numbers them otherwise, say "
                                "in [recording] of the study file which is which: positions = {{ "
                                "\"NUMBER IN THE FILE\" = NUMBER IN THE PLAN, ... }}",
                                several ? "s" : "", fmt::join(others, ", "), more,
                                several ? "are" : "is", rows, plan_.positions.size()));
  }

  void add(std::size_t row) {
    const double t = rec_.find("time")->values[row];
    const double number = rec_.find("position")->values[row];
    Interval i;
    i.position = static_cast<int>(std::lround(number)) - 1;
    const Position& position = plan_.positions[i.position];
    const Passage& passage = passages_[i.position];
    i.slew = phase_ && phase_->values[row] == 1.0;
    i.t1 = t;
    const Interval* before = timeline_.intervals.empty() ? nullptr : &timeline_.intervals.back();
    const bool first_row = !before || before->position != i.position;
    i.cage = !before || (first_row && passage.caged);
    i.t0 = !before  ? t - position.sample
           : i.cage ? std::max(t - position.sample, before->t1)
                    : before->t1;
    if (i.cage && !rec_.begins.empty())
      i.t0 = before ? std::max(rec_.begins[row], before->t1) : rec_.begins[row];
    if (!rec_.samples.empty()) i.samples = rec_.samples[row];
    if (!rec_.readings.empty()) i.readings = rec_.readings[row];
    if (i.cage) {
      ++timeline_.chains;
      chain_start_.push_back(position.R_lp);
      heading_now_ = passage.dwell.heading0;
    }
    i.chain = timeline_.chains - 1;
    command(row, position, i);
    check_change(row, position, before, i);
    i.heading0 = heading_now_;
    i.heading1 = heading_ ? heading_->values[row] : planned_heading(passage, i);
    if (i.cage && heading_) i.heading0 = i.heading1;
    if (!std::isfinite(i.heading1))
      complain(row,
               "case_heading is missing (expected a number in every row). Give it, or leave the "
               "column out");
    heading_now_ = i.heading1;
    if (!before && !passage.caged) chain_start_.back() = begun_on_the_way(row, i, position.R_lp);
    take_loop(row, i);
    timeline_.intervals.push_back(i);
  }

  bool has_loop() const {
    return std::ranges::all_of(loop_, [](const Channel* c) { return c != nullptr; });
  }
  void take_loop(std::size_t row, Interval& i) {
    if (!has_loop()) return;
    for (int a = 0; a < 6; ++a) i.loop[a] = loop_[a]->values[row];
    if (!i.loop.allFinite())
      complain(row,
               "loop_eta_x .. loop_xi_z: not all are numbers (expected numbers in every row: the "
               "loop removes them). Write 0 where nothing was removed, or leave the columns out");
  }
  /// Zero would be a loop that removes nothing, which nobody has said.
  void tell_loop() {
    timeline_.loop_told = has_loop();
    if (!has_loop())
      timeline_.without_loop = {rec_.source.empty() ? std::string("the recording") : rec_.source};
  }

  /// Where a platform was that had been slewed before the recording began: nobody knows what drift
  /// had done to it but the gimbals, which show it at the end of the first row. Without them it was
  /// where the plan has it.
  Mat3 begun_on_the_way(std::size_t row, const Interval& i, const Mat3& planned) const {
    const auto angles = measured(rec_, gimbal_channels, row);
    if (!angles) return planned;
    const Mat3 R_lp_end = case_attitude(i.heading1) * gimbal_chain(*angles);
    return rotation<double>(site_.omega_ie_l() * i.length()) * R_lp_end *
           rotation<double>(-i.omega_cmd_p * i.length());
  }

  /// The command of a row acts since the row before. Where it changed while rows were missing,
  /// nothing says when, unless the recording was made ready (`begins`).
  void check_change(std::size_t row, const Position& position, const Interval* before,
                    const Interval& i) {
    if (!before || i.cage || !rec_.begins.empty() ||
        !RowSpacing::lost_within(i.length(), position.sample))
      return;
    const bool dwells = !before->slew && !i.slew;
    const bool held = (i.omega_cmd_p - before->omega_cmd_p).cwiseAbs().maxCoeff() < same_command;
    if (held && !(dwells && before->position != i.position)) return;
    complain(row, fmt::format("gap of {:.6g} s before this row in which the command changed, but "
                              "the attitude is carried along here (samples {:.6g} s apart "
                              "expected). Give the missing rows, or mark the position as caged",
                              i.length(), position.sample));
  }

  void command(std::size_t row, const Position& position, Interval& i) {
    if (cmd_[0]) {
      for (int a = 0; a < 3; ++a) i.omega_cmd_p[a] = cmd_[a]->values[row];
      if (!i.omega_cmd_p.allFinite())
        complain(row,
                 "cmd_x, cmd_y, cmd_z: not all are numbers (expected numbers in every row: the "
                 "platform obeys them). Write 0 where nothing was commanded");
    } else if (i.slew) {
      complain(row,
               "a slew (phase 1) without commands (expected columns cmd_x, cmd_y, cmd_z). Record "
               "the commands");
    } else if (position.mode == CommandLaw::level) {
      i.omega_cmd_p = position.R_lp.transpose() * site_.omega_ie_l();
    }
  }

  /// Without a column, the case heads as planned; it turns evenly between rows that are slews.
  double planned_heading(const Passage& passage, const Interval& i) const {
    if (!i.slew || passage.approach.empty()) return passage.dwell.heading1;
    const Stretch& turn = passage.approach.front();
    const double rate = (turn.heading1 - turn.heading0) / turn.duration;
    const double next = heading_now_ + rate * i.length();
    return rate >= 0.0 ? std::min(next, turn.heading1) : std::max(next, turn.heading1);
  }

  /// A covariate at the end of every row, gaps closed by straight lines; empty if there is none.
  std::vector<double> column(std::string_view name) const {
    const Channel* c = rec_.find(name);
    if (!c) return {};
    std::vector<double> values = c->values;
    std::optional<std::size_t> known;
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (!std::isfinite(values[k])) continue;
      const std::size_t from = known ? *known + 1 : 0;
      for (std::size_t m = from; m < k; ++m) {
        const double share = known ? (time(m) - time(*known)) / (time(k) - time(*known)) : 1.0;
        values[m] = known ? values[*known] + share * (values[k] - values[*known]) : values[k];
      }
      known = k;
    }
    if (!known) return {};
    for (std::size_t m = *known + 1; m < values.size(); ++m) values[m] = values[*known];
    return values;
  }
  double time(std::size_t row) const { return rec_.find("time")->values[row]; }

  void take_covariates() {
    for (const CovariateSpec& c : known_covariates) {
      std::array<std::vector<double>, 3> values;
      bool known = true;
      for (std::size_t k = 0; k < c.components(); ++k) {
        values[k] = column(c.column(k));
        known = known && !values[k].empty();
      }
      if (!known) continue;
      timeline_.carried |= c.set();
      for (std::size_t k = 0; k < c.components(); ++k)
        carry(values[k], c.first + k, c.is_vector() ? 0.0 : mean_of(values[k]));
    }
    for (std::size_t k = 0; k < own_terms().covariates.size(); ++k) {
      const std::string& name = own_terms().covariates[k];
      std::vector<double> values = column(name);
      if (values.empty()) continue;
      if (const auto wrong = take_celsius(values, *rec_.find(name)))
        complain(wrong->row, wrong->text);
      timeline_.carried |= further_column(k);
      carry(values, covariate_components + k, 0.0);
    }
  }
  static double mean_of(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double v : values) sum += v;
    return sum / static_cast<double>(values.size());
  }
  /// Number `place` of every interval's covariates, from the values at the ends of the rows.
  void carry(const std::vector<double>& values, std::size_t place, double mean) {
    std::vector<Interval>& intervals = timeline_.intervals;
    timeline_.mean.value[place] = mean;
    for (std::size_t k = 0; k < intervals.size(); ++k) {
      const bool joins = k > 0 && intervals[k].t0 == intervals[k - 1].t1;
      intervals[k].around0.value[place] = values[joins ? k - 1 : k] - mean;
      intervals[k].around1.value[place] = values[k] - mean;
    }
  }

  const Recording& rec_;
  const TestPlan& plan_;
  const Site& site_;
  std::vector<Passage> passages_;
  const Channel *heading_ = nullptr, *phase_ = nullptr;
  std::array<const Channel*, 3> cmd_{};
  std::array<const Channel*, 6> loop_{};
  Timeline timeline_;
  std::vector<Mat3> chain_start_;
  double heading_now_ = 0.0;
  Problems problems_;
};

}  // namespace

Timeline lay_out(const Recording& recording, const TestPlan& plan, const Site& site) {
  DRIFT_DEMAND(recording.find("time") != nullptr && recording.find("position") != nullptr);
  for (const Channel& c : recording.channels) DRIFT_DEMAND(c.values.size() == recording.rows());
  require_memory(memory_of_samples(static_cast<double>(recording.rows())), ExitCode::recording,
                 fmt::format("{}: {} rows", recording.source, recording.rows()),
                 "Average the rows to longer samples, or cut the recording");
  return Reader(recording, plan, site).read();
}

}  // namespace drift
