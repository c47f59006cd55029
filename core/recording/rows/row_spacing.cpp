#include "core/recording/rows/row_spacing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/check.hpp"
#include "core/stats/median.hpp"

namespace drift {
namespace {

constexpr std::size_t reach = 8;      // rows to either side: three of four may follow a lost one
constexpr std::size_t few_steps = 8;  // of a stretch, to be judged by itself
constexpr int uneven = 3;  // changes of the step or more: it is not longer from somewhere on
constexpr double same_step = 1e-3;
constexpr double alike = 0.1;  // part by which steps of one kind differ

/// Rows of one position and phase.
struct SpacedRows {
  std::size_t first = 0, end = 0;
  bool position_begins = false;
  double phase = 0.0;
};

std::vector<SpacedRows> stretches_of(const Recording& r) {
  const Channel* position = r.find("position");
  const Channel* phase = r.find("phase");
  std::vector<SpacedRows> all;
  for (std::size_t row = 0; row < r.rows(); ++row) {
    const bool begins =
        row == 0 || (position && position->values[row] != position->values[row - 1]);
    if (begins || (phase && phase->values[row] != phase->values[row - 1]))
      all.push_back({row, row, begins, phase && phase->values[row] == 1.0 ? 1.0 : 0.0});
    all.back().end = row + 1;
  }
  return all;
}

/// The step of even rows of which some are lost, half of them or more: steps are one to a few of
/// those that are usual in the whole phase and change again and again, as means over longer do not.
/// NaN if they are not so.
double step_with_losses(const std::vector<double>& steps, double of_phase) {
  double seconds = 0.0, whole = 0.0, before = nan_value;
  int changes = 0;
  bool single = false;
  for (const double step : steps) {
    const double times = std::round(step / of_phase);
    if (times < 1.0 || std::abs(step - times * of_phase) > alike * of_phase) return nan_value;
    if (!std::isnan(before) && times != before) ++changes;
    single = single || times == 1.0;
    before = times;
    seconds += step;
    whole += times;
  }
  const bool few_left = whole > 4.0 * static_cast<double>(steps.size());  // or rows of other kinds
  return single && changes >= uneven && !few_left ? seconds / whole : nan_value;
}

/// The usual one of the steps around a row. Where every other row is lost the median is that of
/// gaps: a quarter of the steps that are as usual in the whole phase tell it from longer rows, and
/// so do uneven steps of rows that name a position: what names none may be read now and then.
double usual_of(std::vector<double> steps, double of_phase, bool names_position) {
  const double with_losses = names_position ? step_with_losses(steps, of_phase) : nan_value;
  std::ranges::sort(steps);
  const double median = steps[steps.size() / 2], quartile = steps[(steps.size() - 1) / 4];
  if (!RowSpacing::lost_within(median, of_phase)) return median;
  if (std::abs(quartile - of_phase) < alike * of_phase) return quartile;
  return std::isnan(with_losses) ? median : with_losses;
}

/// The usual step around each row of a stretch. Its first row says how far it is from another
/// stretch, which is no evidence of its own steps.
void fill_usual(const SpacedRows& s, double of_phase, bool names_position, RowSpacing& out) {
  const std::size_t own = s.first + 1;
  for (std::size_t row = s.first; row < s.end; ++row) {
    const std::size_t centre = std::max(row, own);
    const std::size_t from = centre - std::min(reach, centre - own);
    const std::size_t to = std::min(s.end, centre + reach + 1);
    out.usual[row] = usual_of({out.step.begin() + static_cast<std::ptrdiff_t>(from),
                               out.step.begin() + static_cast<std::ptrdiff_t>(to)},
                              of_phase, names_position);
  }
}

/// Steps within the stretches of a phase, in units of so many seconds at each row.
std::vector<double> steps_of(const std::vector<SpacedRows>& stretches, double phase,
                             const RowSpacing& out, const std::vector<double>& unit) {
  std::vector<double> steps;
  for (const SpacedRows& s : stretches)
    if (s.phase == phase)
      for (std::size_t row = s.first + 1; row < s.end; ++row)
        steps.push_back(out.step[row] / unit[row]);
  return steps;
}

/// The usual step of a phase: in seconds, or in samples of the plan where steps are as much alike
/// in those or more. NaN if no stretch of it has two rows.
struct UsualOfPhase {
  double step = nan_value;
  bool in_samples = false;

  /// [s] where a sample of the plan is as long as that.
  double seconds(double sample) const { return in_samples ? step * sample : step; }
};

UsualOfPhase usual_of_phase(const std::vector<SpacedRows>& stretches, double phase,
                            const RowSpacing& out, const std::vector<double>& samples) {
  const auto of = [&](const std::vector<double>& unit) {
    const std::vector<double> steps = steps_of(stretches, phase, out, unit);
    if (steps.empty()) return std::pair{nan_value, 0.0};
    const double usual = stats::upper_median(steps);
    double unlike = 0.0;
    for (const double step : steps) unlike += std::abs(std::log(step / usual));
    return std::pair{usual, unlike};
  };
  const auto [seconds, unlike_in_seconds] = of(std::vector<double>(samples.size(), 1.0));
  const auto [in_samples, unlike_in_samples] = of(samples);
  return unlike_in_samples <= unlike_in_seconds ? UsualOfPhase{in_samples, true}
                                                : UsualOfPhase{seconds, false};
}

/// The usual step of a stretch of a few rows: that of its phase, unless its own ones, two or more,
/// are alike, and as the plan has them if there is one (else NaN). That rows are lost so evenly has
/// a chance of (q (1 - q))^n for n steps where a part q of the rows is lost: 0.2 % for two and 5 %.
double usual_of_few(const SpacedRows& s, double of_phase, double planned, const RowSpacing& out) {
  if (s.end - s.first < 3) return of_phase;
  const auto [least, most] =
      std::minmax_element(out.step.begin() + static_cast<std::ptrdiff_t>(s.first) + 1,
                          out.step.begin() + static_cast<std::ptrdiff_t>(s.end));
  const double own = 0.5 * (*least + *most);
  const bool as_others = std::abs(own - of_phase) < alike * of_phase;
  const bool meant = std::isnan(planned) || std::abs(own - planned) < alike * planned;
  return !as_others && meant && *most - *least < alike * own ? own : of_phase;
}

}  // namespace

double RowSpacing::missing(std::size_t row) const {
  const double around = std::max(usual[row], usual[row - 1]);
  return std::max(1.0, std::round((step[row] - usual[row]) / around));
}

bool RowSpacing::longer(std::size_t row) const {
  return step[row] > usual[row] + 0.5 * std::min(usual[row], usual[row - 1]);
}

RowSpacing row_spacing(const Recording& recording, const std::vector<double>& planned) {
  DRIFT_EXPECTS(planned.empty() || planned.size() == recording.rows());
  const std::size_t n = recording.rows();
  const auto& t = recording.find("time")->values;
  RowSpacing out{std::vector<double>(n, nan_value), std::vector<double>(n, nan_value)};
  for (std::size_t row = 1; row < n; ++row) out.step[row] = t[row] - t[row - 1];
  const std::vector<SpacedRows> stretches = stretches_of(recording);
  // In those of the first row: where the plan has one for all, steps are what they are in seconds.
  std::vector<double> samples(n, 1.0);
  for (std::size_t row = 0; row < planned.size(); ++row)
    samples[row] = planned[row] / planned.front();
  // A stretch of a few rows, some of which may be lost, is like the others of its phase; a phase of
  // single rows is like the whole recording.
  std::array<UsualOfPhase, 2> of_phase{usual_of_phase(stretches, 0.0, out, samples),
                                       usual_of_phase(stretches, 1.0, out, samples)};
  for (const int phase : {0, 1})
    if (std::isnan(of_phase[phase].step)) of_phase[phase] = of_phase[1 - phase];
  for (const SpacedRows& s : stretches) {
    const double usual = of_phase[s.phase == 1.0 ? 1 : 0].seconds(samples[s.first]);
    if (s.end - s.first > few_steps)
      fill_usual(s, usual, recording.find("position") != nullptr, out);
    else
      std::fill(out.usual.begin() + static_cast<std::ptrdiff_t>(s.first),
                out.usual.begin() + static_cast<std::ptrdiff_t>(s.end),
                usual_of_few(s, usual, planned.empty() ? nan_value : planned[s.first], out));
  }

  out.shortest = std::numeric_limits<double>::infinity();
  double squares = 0.0, steps = 0.0;
  for (const SpacedRows& s : stretches)
    for (std::size_t row = s.first; row < s.end; ++row) {
      if (std::isnan(out.usual[row])) continue;
      out.shortest = std::min(out.shortest, out.usual[row]);
      out.longest = std::max(out.longest, out.usual[row]);
      if (row == s.first && s.position_begins) continue;  // it may have been caged
      const double off = out.step[row] - out.usual[row];
      if (std::abs(off) > same_step * out.usual[row]) out.regular = false;
      if (out.gap(row)) continue;
      squares += off * off;
      steps += 1.0;
    }
  out.regular = out.regular && out.longest - out.shortest <= same_step * out.longest;
  out.jitter = steps > 0.0 ? std::sqrt(squares / steps) : nan_value;
  return out;
}

}  // namespace drift
