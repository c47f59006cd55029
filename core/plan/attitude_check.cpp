#include "core/plan/attitude_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/physics/gimbals.hpp"
#include "core/plan/case_heading.hpp"
#include "core/recording/recording_channels.hpp"

namespace drift {
namespace {

constexpr double largest_mismatch = 10.0 * detail::deg;
constexpr std::size_t fewest_sights = 3;  // fewer fit several guesses

/// What three channels said in one row, and the attitude that it should be.
struct Sight {
  std::size_t row = 0;
  int position = 0;
  double heading = 0.0;  ///< of the case
  double planned = 0.0;  ///< heading of the case in the plan
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

/// Something else than exchanged columns that may be wrong with gimbal angles, and what to do.
struct Slip {
  void (*undo)(Sight&);
  std::string_view text;
};

constexpr double rad_per_deg = detail::deg;
constexpr Slip slips[] = {
    {[](Sight& s) { s.seen /= rad_per_deg; },
     "gimbal_outer, gimbal_middle, gimbal_inner are in another unit: the numbers look like [rad], "
     "not [deg]. Correct the unit"},
    {[](Sight& s) { s.seen *= rad_per_deg; },
     "gimbal_outer, gimbal_middle, gimbal_inner are in another unit: the numbers look like [deg], "
     "not [rad]. Correct the unit"},
    {[](Sight& s) { s.heading = -s.heading; },
     "the sign of case_heading is wrong (it counts from North over West). Correct the recording, "
     "or say so in the study: [recording] columns = { case_heading = \"-case_heading\" }, with its "
     "unit as in the header"},
    {[](Sight& s) { s.heading = s.planned; },
     "case_heading is not that of the plan, the gimbals are. Leave the column out, or correct it"},
    {[](Sight& s) { s.heading = 0.0; },
     "the case faced North in all of them. Set case_heading = \"0 deg\" in the positions of the "
     "plan, or record case_heading"},
    {[](Sight& s) { s.heading /= rad_per_deg; },
     "case_heading is in another unit: the numbers look like [rad], not [deg]. Correct the unit"},
    {[](Sight& s) { s.heading *= rad_per_deg; },
     "case_heading is in another unit: the numbers look like [deg], not [rad]. Correct the unit"},
    {[](Sight& s) {
       s.seen /= rad_per_deg;
       s.heading /= rad_per_deg;
     },
     "gimbal_outer, gimbal_middle, gimbal_inner and case_heading are in another unit: the numbers "
     "look like [rad], not [deg]. Correct the units"},
    {[](Sight& s) {
       s.seen *= rad_per_deg;
       s.heading *= rad_per_deg;
     },
     "gimbal_outer, gimbal_middle, gimbal_inner and case_heading are in another unit: the numbers "
     "look like [deg], not [rad]. Correct the units"},
};

/// The first slip whose undoing brings every sight into place; simpler ones stand first.
const Slip* slip_behind(const std::vector<Sight>& sights) {
  if (sights.size() < fewest_sights) return nullptr;
  for (const Slip& slip : slips)
    if (std::ranges::all_of(sights, [&](Sight s) {
          slip.undo(s);
          return of_gimbals(s, s.seen) < largest_mismatch;
        }))
      return &slip;
  return nullptr;
}

/// All positions that are elsewhere, in one message.
std::string elsewhere_text(const TestPlan& plan, const std::vector<Sight>& wrong, std::size_t all,
                           Mismatch mismatch, const char* what) {
  constexpr std::size_t most = 4;
  std::vector<std::string> places;
  for (const Sight& s : wrong)
    if (places.size() < most)
      places.push_back(fmt::format("position {} ('{}') {:.0f} deg", s.position + 1,
                                   plan.positions[static_cast<std::size_t>(s.position)].name,
                                   mismatch(s, s.seen) / detail::deg));
  return fmt::format(
      "in {} of {} positions the {} away from the attitude in the plan (expected at most {:.0f} "
      "deg): {}{}. Is this the plan, and the order of positions, the recording was made with?",
      wrong.size(), all, what, largest_mismatch / detail::deg, fmt::join(places, ", "),
      wrong.size() > most ? fmt::format(" and {} more", wrong.size() - most) : "");
}

/// One kind of instrument.
std::vector<RowMistake> mistakes_of(const TestPlan& plan, const std::vector<Sight>& sights,
                                    const ChannelTriple& channels, Mismatch mismatch,
                                    const char* what) {
  std::vector<Sight> wrong;
  for (const Sight& s : sights)
    if (!(mismatch(s, s.seen) < largest_mismatch)) wrong.push_back(s);
  if (wrong.empty()) return {};
  const std::size_t row = wrong.front().row;
  if (const auto mixup = mixup_behind(sights, mismatch))
    return {{row, mixup_text(*mixup, channels, sights.size())}};
  if (const Slip* slip = mismatch == of_gimbals ? slip_behind(sights) : nullptr)
    return {{row,
             fmt::format("in {} of {} positions the gimbal angles do not show the attitude of "
                         "the plan (expected within {:.0f} deg); all would if this were so: {}",
                         wrong.size(), sights.size(), largest_mismatch / detail::deg, slip->text)}};
  return {{row, elsewhere_text(plan, wrong, sights.size(), mismatch, what)}};
}

std::vector<Sight> sights_of(const Recording& recording, const TestPlan& plan,
                             const Timeline& timeline, const ChannelTriple& channels) {
  std::vector<Sight> all;
  const std::vector<Passage> passages = plan_passages(plan, timeline.site);
  for (std::size_t k = 0; k < timeline.intervals.size(); ++k) {
    const Interval& i = timeline.intervals[k];
    if (!i.cage) continue;
    if (const auto seen = measured(recording, channels, k))
      all.push_back({k, i.position, i.heading1,
                     passages[static_cast<std::size_t>(i.position)].dwell.heading1,
                     timeline.nodes[i.last_node()].R_lr, *seen});
  }
  return all;
}

}  // namespace

std::vector<RowMistake> attitude_mistakes(const Recording& recording, const TestPlan& plan,
                                          const Timeline& timeline) {
  std::vector<RowMistake> all =
      mistakes_of(plan, sights_of(recording, plan, timeline, accelerometer_channels),
                  accelerometer_channels, of_accelerometers, "accelerometers show Up");
  std::vector<RowMistake> of_resolvers =
      mistakes_of(plan, sights_of(recording, plan, timeline, gimbal_channels), gimbal_channels,
                  of_gimbals, "gimbal angles are");
  all.insert(all.end(), of_resolvers.begin(), of_resolvers.end());
  std::ranges::stable_sort(all, {}, &RowMistake::row);
  return all;
}

}  // namespace drift
