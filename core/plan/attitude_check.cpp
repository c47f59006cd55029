#include "core/plan/attitude_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/physics/gimbals.hpp"
#include "core/recording/recording_channels.hpp"

namespace drift {
namespace {

constexpr double largest_mismatch = 10.0 * detail::deg;

/// What three channels said in one row, and the attitude that it should be.
struct Sight {
  std::size_t row = 0;
  int position = 0;
  double heading = 0.0;  ///< of the case
  Mat3 R_lr;             ///< of the plan
  Vec3 seen;
};

/// How far an attitude is from the plan's as a kind of instrument sees it [rad].
using Mismatch = double (*)(const Sight&, const Vec3& seen);

double of_accelerometers(const Sight& s, const Vec3& seen) {
  const Vec3 expected = s.R_lr.row(2);
  return std::atan2(seen.cross(expected).norm(), seen.dot(expected));
}

double of_gimbals(const Sight& s, const Vec3& seen) {
  const Mat3 R_lp = case_attitude(s.heading) * gimbal_chain(seen);
  return rotation_vector(s.R_lr.transpose() * R_lp).norm();
}

/// Three columns as they may have been exchanged or reversed.
struct Mixup {
  std::array<int, 3> from{0, 1, 2};
  std::array<double, 3> sign{1.0, 1.0, 1.0};

  Vec3 of(const Vec3& v) const {
    return {sign[0] * v[from[0]], sign[1] * v[from[1]], sign[2] * v[from[2]]};
  }
  int changes() const {
    int n = 0;
    for (int i = 0; i < 3; ++i) n += from[i] != i || sign[i] < 0.0;
    return n;
  }
};

/// The one mixup with the fewest changes that brings every sight into place; none if several do.
std::optional<Mixup> mixup_behind(const std::vector<Sight>& sights, Mismatch mismatch) {
  constexpr std::size_t fewest_sights = 3;  // fewer fit several mixups
  if (sights.size() < fewest_sights) return std::nullopt;
  std::optional<Mixup> found;
  bool several = false;
  Mixup m;
  do {
    for (int signs = 0; signs < 8; ++signs) {
      for (int i = 0; i < 3; ++i) m.sign[i] = (signs >> i & 1) != 0 ? -1.0 : 1.0;
      if (m.changes() == 0 || (found && m.changes() > found->changes())) continue;
      if (!std::ranges::all_of(
              sights, [&](const Sight& s) { return mismatch(s, m.of(s.seen)) < largest_mismatch; }))
        continue;
      several = found && m.changes() == found->changes();
      found = m;
    }
  } while (std::next_permutation(m.from.begin(), m.from.end()));
  return several ? std::nullopt : found;
}

std::string mixup_text(const Mixup& m, const ChannelTriple& channels, std::size_t positions) {
  std::vector<std::string> wrong, map;
  for (int i = 0; i < 3; ++i)
    if (m.from[i] != i || m.sign[i] < 0.0) {
      wrong.emplace_back(channels.names[i]);
      map.push_back(fmt::format("{} = \"{}{}\"", channels.names[i], m.sign[i] < 0.0 ? "-" : "",
                                channels.names[m.from[i]]));
    }
  return fmt::format(
      "column{} {}: {} (all {} positions have the attitude of the plan with {}). Correct the "
      "recording, or say so in the study: [recording] columns = {{ {} }}, each with its unit as in "
      "the header",
      wrong.size() > 1 ? "s" : "", fmt::join(wrong, ", "),
      wrong.size() == 1 ? "the sign is wrong" : "exchanged or of the wrong sign", positions,
      fmt::join(map, ", "), fmt::join(map, ", "));
}

/// One kind of instrument.
std::vector<RowMistake> mistakes_of(const TestPlan& plan, const std::vector<Sight>& sights,
                                    const ChannelTriple& channels, Mismatch mismatch,
                                    const char* what) {
  std::vector<RowMistake> wrong;
  for (const Sight& s : sights) {
    const double angle = mismatch(s, s.seen);
    if (angle < largest_mismatch) continue;
    wrong.push_back(
        {s.row, fmt::format(
                    "position {} ('{}'): the {} {:.0f} deg from the attitude in the plan (expected "
                    "at most {:.0f}). Is this the plan, and the order of positions, the recording "
                    "was made with?",
                    s.position + 1, plan.positions[static_cast<std::size_t>(s.position)].name, what,
                    angle / detail::deg, largest_mismatch / detail::deg)});
  }
  if (wrong.empty()) return wrong;
  if (const auto mixup = mixup_behind(sights, mismatch))
    return {{wrong.front().row, mixup_text(*mixup, channels, sights.size())}};
  return wrong;
}

std::vector<Sight> sights_of(const Recording& recording, const Timeline& timeline,
                             const ChannelTriple& channels) {
  std::vector<Sight> all;
  for (std::size_t k = 0; k < timeline.intervals.size(); ++k) {
    const Interval& i = timeline.intervals[k];
    if (!i.cage) continue;
    if (const auto seen = measured(recording, channels, k))
      all.push_back({k, i.position, i.heading1, timeline.nodes[i.last_node()].R_lr, *seen});
  }
  return all;
}

}  // namespace

std::vector<RowMistake> attitude_mistakes(const Recording& recording, const TestPlan& plan,
                                          const Timeline& timeline) {
  std::vector<RowMistake> all =
      mistakes_of(plan, sights_of(recording, timeline, accelerometer_channels),
                  accelerometer_channels, of_accelerometers, "accelerometers show Up");
  std::vector<RowMistake> of_resolvers =
      mistakes_of(plan, sights_of(recording, timeline, gimbal_channels), gimbal_channels,
                  of_gimbals, "gimbal angles are");
  all.insert(all.end(), of_resolvers.begin(), of_resolvers.end());
  std::ranges::stable_sort(all, {}, &RowMistake::row);
  return all;
}

}  // namespace drift
