#include "analysis/diagnosis/held_out/held_out_part.hpp"

#include <limits>
#include <set>

namespace drift::diagnosis {
namespace {

/// Positions (from 0) that have rows in the marked intervals.
std::set<int> positions_in(const inference::MeasuredRows& rows,
                           const std::vector<bool>& intervals) {
  std::set<int> found;
  for (const inference::RowTag& t : rows.tags)
    if (intervals[t.interval]) found.insert(t.position);
  return found;
}

}  // namespace

std::vector<HeldOutPart> positions_of(const inference::MeasuredRows& rows) {
  const std::set<int> positions = positions_in(rows, std::vector<bool>(rows.drives.size(), true));
  std::vector<HeldOutPart> parts;
  if (positions.size() < 2) return parts;
  for (const int p : positions) {
    HeldOutPart part{
        Fold::Of::position, p + 1, {p + 1}, std::vector<bool>(rows.drives.size(), false)};
    for (const inference::RowTag& t : rows.tags)
      if (t.position == p) part.intervals[t.interval] = true;
    parts.push_back(std::move(part));
  }
  return parts;
}

std::vector<HeldOutPart> recordings_of(const inference::MeasuredRows& rows,
                                       const std::vector<std::size_t>& ends) {
  std::vector<HeldOutPart> parts;
  for (std::size_t r = 0; r < ends.size(); ++r) {
    HeldOutPart part{Fold::Of::recording,
                     static_cast<int>(r) + 1,
                     {},
                     std::vector<bool>(rows.drives.size(), false)};
    for (std::size_t i = r == 0 ? 0 : ends[r - 1]; i < ends[r]; ++i) part.intervals[i] = true;
    for (const int p : positions_in(rows, part.intervals)) part.positions.push_back(p + 1);
    if (!part.positions.empty()) parts.push_back(std::move(part));
  }
  if (parts.size() < 2) parts.clear();
  return parts;
}

Measurements without_intervals(const Measurements& measured, const std::vector<bool>& left_out) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  Measurements out = measured;
  for (std::size_t i = 0; i < left_out.size(); ++i)
    if (left_out[i])
      for (Mat3X* values : {&out.acc, &out.gimbal})
        values->col(static_cast<Eigen::Index>(i)).setConstant(nothing);
  return out;
}

}  // namespace drift::diagnosis
