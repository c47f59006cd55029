#include "core/plan/plan_rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

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
std::string listed(std::vector<std::size_t> numbers) {
  constexpr std::size_t most = 6;
  const std::size_t more = numbers.size() > most ? numbers.size() - most : 0;
  numbers.resize(numbers.size() - more);
  return fmt::format("{}{}", fmt::join(numbers, ", "),
                     more > 0 ? fmt::format(" and {} more", more) : "");
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
        recording.source, others.size() > 1 ? "s" : "", listed(others), rows[others.front() - 1],
        first.dwell / first.sample));
  }
  return remarks;
}

}  // namespace drift
