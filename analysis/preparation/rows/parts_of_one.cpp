#include "analysis/preparation/rows/parts_of_one.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/nan.hpp"
#include "core/recording/rows/reduce.hpp"

namespace drift::preparation {
namespace {

constexpr double goes_on_within = 2.5;  // samples: one row may be lost at the cut

/// The time since the end of the one at which the other goes on in its position [s]; NaN if it does
/// not.
double pause_between(const Recording& one, const Recording& next) {
  const auto& before = one.find("time")->values;
  const double pause = next.find("time")->values.front() - before.back();
  const double sample =
      std::fmax(sample_intervals(one).typical, sample_intervals(next).typical);  // NaN: one row
  const bool same_position =
      one.find("position")->values.back() == next.find("position")->values.front();
  return same_position && pause > 0.0 && pause <= goes_on_within * sample ? pause : nan_value;
}

}  // namespace

std::vector<std::string> parts_of_one(const std::vector<Recording>& recordings) {
  std::vector<std::string> remarks;
  for (const Recording& next : recordings)
    for (const Recording& one : recordings) {
      const double pause = pause_between(one, next);
      if (std::isnan(pause)) continue;
      remarks.push_back(fmt::format(
          "{0}: begins in position {1}, {2:.4g} s after {3} ends there: parts of one recording? "
          "Each is taken as begun with a caging, at the plan's attitude. If the platform was not "
          "caged between them, join them into one file, the rows of {0} below those of {3}",
          next.source.empty() ? "recording" : next.source, next.find("position")->values.front(),
          pause, one.source.empty() ? "another recording" : one.source));
    }
  return remarks;
}

}  // namespace drift::preparation
