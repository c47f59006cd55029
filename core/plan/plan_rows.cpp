#include "core/plan/plan_rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/words.hpp"
#include "core/recording/rows/row_spacing.hpp"
#include "core/stats/median.hpp"

namespace drift {
namespace {

/// Rows of every position's dwell, by its number in the plan.
std::vector<std::size_t> dwell_rows(const Recording& recording, std::size_t positions) {
  std::vector<std::size_t> rows(positions, 0);
  const Channel* position = recording.find("position");
  const Channel* phase = recording.find("phase");
  for (std::size_t k = 0; position != nullptr && k < recording.rows(); ++k) {
    const double number = position->values[k];
    const bool slew = phase != nullptr && phase->values[k] == 1.0;
    if (!slew && number >= 1.0 && number <= static_cast<double>(positions))
      ++rows[static_cast<std::size_t>(number) - 1];
  }
  return rows;
}

/// "1, 2, 3 and 4 more"
std::string first_few(std::vector<std::size_t> numbers) {
  constexpr std::size_t most = 6;
  const std::size_t more = numbers.size() > most ? numbers.size() - most : 0;
  numbers.resize(numbers.size() - more);
  return fmt::format("{}{}", fmt::join(numbers, ", "),
                     more > 0 ? fmt::format(" and {} more", more) : "");
}

constexpr double step_room = 0.1;  // part by which steps of one kind differ

bool same_length(double a, double b) {
  return std::abs(a - b) < step_room * b;
}

/// How far the rows of a position's dwell are from each other, as they are usually and as planned.
struct DwellStep {
  int position = 0;
  double usual = 0.0, planned = 0.0;  ///< [s]
};

std::vector<DwellStep> dwell_steps(const Recording& recording, const TestPlan& plan) {
  const Channel *position = recording.find("position"), *phase = recording.find("phase");
  if (position == nullptr) return {};
  const RowSpacing spacing = row_spacing(recording, planned_samples(recording, plan));
  std::map<int, std::vector<double>> steps;
  for (std::size_t k = 0; k < recording.rows(); ++k)
    if ((phase == nullptr || phase->values[k] == 0.0) && std::isfinite(spacing.usual[k]))
      steps[static_cast<int>(position->values[k])].push_back(spacing.usual[k]);
  std::vector<DwellStep> all;
  for (const auto& [number, usual] : steps)
    if (const Position* p = planned_position(plan, number))
      all.push_back({number, stats::median(usual), p->sample});
  return all;
}

}  // namespace

const Position* planned_position(const TestPlan& plan, double number) {
  const auto place = static_cast<std::size_t>(std::max(0.0, number));
  return place >= 1 && place <= plan.positions.size() ? &plan.positions[place - 1] : nullptr;
}

std::vector<double> planned_samples(const Recording& recording, const TestPlan& plan) {
  std::vector<double> samples(recording.rows(), plan.positions.front().sample);
  if (const Channel* position = recording.find("position"))
    for (std::size_t row = 0; row < samples.size(); ++row)
      if (const Position* p = planned_position(plan, position->values[row]))
        samples[row] = p->sample;
  return samples;
}

std::vector<std::string> rows_other_than_planned(const Recording& recording, const TestPlan& plan) {
  const auto rows = dwell_rows(recording, plan.positions.size());
  std::vector<std::size_t> others;
  for (std::size_t p = 0; p < rows.size(); ++p) {
    const double planned = plan.positions[p].dwell / plan.positions[p].sample;
    if (rows[p] > 0 && std::abs(static_cast<double>(rows[p]) - planned) > 1.5)
      others.push_back(p + 1);
  }
  std::vector<std::string> remarks;
  if (!others.empty()) {
    const Position& first = plan.positions[others.front() - 1];
    remarks.push_back(fmt::format(
        "{}: position{} {}: not as many rows as planned: {} where the plan has {:.0f}. Each row "
        "counts as one measurement with the noise of [readout]; check plan.sample and plan.dwell",
        recording.source, others.size() > 1 ? "s" : "", first_few(others), rows[others.front() - 1],
        first.dwell / first.sample));
  }
  return remarks;
}

std::string rows_longer_than_others(const Recording& recording, const TestPlan& plan) {
  const std::vector<DwellStep> all = dwell_steps(recording, plan);
  if (all.empty()) return "";
  const DwellStep least = *std::ranges::min_element(all, {}, &DwellStep::usual);
  std::vector<int> positions;
  double from = 0.0, to = 0.0;
  std::size_t others = 0;
  for (const DwellStep& s : all) {
    if (same_length(s.usual, least.usual)) ++others;
    const double times = std::round(s.usual / least.usual);
    const bool whole =
        times >= 2.0 && std::abs(s.usual - times * least.usual) < step_room * least.usual;
    const bool meant = same_length(s.usual, s.planned) ||
                       !(s.usual / s.planned > 1.5 * least.usual / least.planned);
    if (!whole || meant) continue;
    from = positions.empty() ? s.usual : std::min(from, s.usual);
    to = std::max(to, s.usual);
    positions.push_back(s.position);
  }
  const bool as_planned = same_length(least.usual, least.planned);
  if (positions.empty() || !(as_planned || 2 * others > all.size())) return "";
  const std::string apart = same_length(to, from) ? fmt::format("{:.4g} s", from)
                                                  : fmt::format("{:.4g} to {:.4g} s", from, to);
  return fmt::format(
      "rows of {} are {} apart where those of others are {:.4g} s: their accelerometers are taken "
      "as means over that. If they are, nothing is to be done; if rows were lost, put each back at "
      "its time, the position and commands as they were, the cells of its sensors empty: then the "
      "others are means over {:.4g} s",
      positions_text(positions), apart, least.usual, least.usual);
}

}  // namespace drift
