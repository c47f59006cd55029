#include "analysis/preparation/gimbals_behind_gaps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "analysis/preparation/lost_rows.hpp"
#include "core/plan/attitude_slips.hpp"
#include "core/plan/mixup.hpp"
#include "core/recording/recording_channels.hpp"

namespace drift::preparation {
namespace {

/// The recording with gimbal angles that are `times` as large and mixed up.
Recording taken(Recording r, const Mixup& mixup, double times) {
  std::array<std::vector<double>*, 3> angles{};
  for (std::size_t a = 0; a < 3; ++a)
    angles[a] = &std::ranges::find(r.channels, gimbal_channels.names[a], &Channel::name)->values;
  for (std::size_t row = 0; row < r.rows(); ++row) {
    const Vec3 v = mixup.of({(*angles[0])[row], (*angles[1])[row], (*angles[2])[row]});
    for (int a = 0; a < 3; ++a) (*angles[static_cast<std::size_t>(a)])[row] = times * v[a];
  }
  return r;
}

}  // namespace

std::string gimbals_behind_gaps(const Recording& r, const mc::Study& study) {
  for (const std::string_view name : gimbal_channels.names)
    if (r.find(name) == nullptr) return "";
  const auto closes = [&](const Mixup& mixup, double times) {
    std::vector<std::string> remarks, wrong;
    with_begins(taken(r, mixup, times), study, remarks, wrong);
    return wrong.empty();
  };
  const std::string name = r.source.empty() ? "recording" : r.source;
  if (const auto mixup = the_one_mixup([&](const Mixup& m) { return closes(m, 1.0); }))
    return fmt::format("{}: {}", name,
                       mixup_text(*mixup, gimbal_channels,
                                  "in slews the platform turned as commanded, and no row is "
                                  "missing"));
  const Unit& said = r.find(gimbal_channels.names[0])->unit;
  std::vector<std::string_view> units;
  for (const auto& [symbol, to_si] : angle_units())
    if (to_si != said.to_si && closes({}, to_si / said.to_si)) units.push_back(symbol);
  if (units.size() != 1) return "";
  return fmt::format(
      "{}: gimbal_outer, gimbal_middle, gimbal_inner are in another unit: the platform turned in "
      "slews as commanded if they are in [{}], not [{}]. Correct the unit",
      name, units.front(), said.symbol.view());
}

}  // namespace drift::preparation
