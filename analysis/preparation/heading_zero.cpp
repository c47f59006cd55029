#include "analysis/preparation/heading_zero.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include "analysis/preparation/input_thresholds.hpp"
#include "core/physics/gimbals.hpp"
#include "core/plan/case_heading.hpp"
#include "core/plan/timeline.hpp"
#include "core/recording/recording_channels.hpp"

namespace drift::preparation {
namespace {

/// A caged position: by what the attitude that is read is turned from that of the plan, and by how
/// much more drift may have turned it by then.
struct Caged {
  Vec3 turn_l;         ///< local axes [rad]
  double room = 0.0;   ///< [rad]
  bool inner = false;  ///< the axis of the inner gimbal stands on Up: its zero looks the same
};

/// By what the attitude that a row reads is turned from the plan's, local axes; none if not read.
std::optional<Vec3> turn_of(const Recording& recording, const Timeline& timeline, std::size_t k) {
  const auto seen = measured(recording, gimbal_channels, k);
  if (!seen) return std::nullopt;
  const Interval& i = timeline.intervals[k];
  const Mat3 R_lp = case_attitude(i.heading1) * gimbal_chain(*seen);
  return rotation_vector(R_lp * timeline.nodes[i.last_node()].R_lr.transpose());
}

/// The same at the instant of caging: the drift of the second row is that of the first.
std::optional<Vec3> turn_at_caging(const Recording& recording, const Timeline& timeline,
                                   std::size_t k) {
  const auto first = turn_of(recording, timeline, k);
  if (!first || k + 1 >= timeline.intervals.size()) return first;
  const Interval &i = timeline.intervals[k], &next = timeline.intervals[k + 1];
  if (next.cage || next.slew || next.position != i.position) return first;
  const auto second = turn_of(recording, timeline, k + 1);
  return second ? Vec3(*first - (*second - *first) * (i.length() / next.length())) : first;
}

std::vector<Caged> caged_in(const Recording& recording, const Timeline& timeline, double caging) {
  std::vector<Caged> all;
  for (std::size_t k = 0; k < timeline.intervals.size(); ++k) {
    const Interval& i = timeline.intervals[k];
    if (!i.cage || i.slew) continue;
    const auto turn = turn_at_caging(recording, timeline, k);
    if (!turn) continue;
    all.push_back(
        {*turn, GimbalZeroLimits::least * caging + timeline.site.omega_ie_l().norm() * i.length(),
         std::abs(timeline.nodes[i.last_node()].R_lr(2, 2)) > 0.9});
  }
  return all;
}

/// "0 deg, 0 deg, 45 deg": the headings of the plan's dwells, all of them so much further.
std::string headings_text(const mc::Study& study, double further) {
  std::vector<std::string> all;
  for (const Passage& p : plan_passages(study.plan, study.site))
    all.push_back(fmt::format("{:.4g}", (p.dwell.heading1 + further) / detail::deg));
  return fmt::format("{}", fmt::join(all, ", "));
}

}  // namespace

std::string heading_off_zero(const mc::Study& study, const Recording& recording) {
  double caging = 0.0;  // 1 sigma
  for (const FilterSpec& filter : study.filters) caging = std::max(caging, filter.initial_attitude);
  const std::vector<Caged> all =
      caged_in(recording, lay_out(recording, study.plan, study.site), caging);
  if (all.empty()) return "";
  const double sum = std::accumulate(all.begin(), all.end(), 0.0,
                                     [](double s, const Caged& c) { return s + c.turn_l.z(); });
  const double zero = sum / static_cast<double>(all.size());
  const bool same = std::ranges::all_of(all, [&](const Caged& c) {
    return std::abs(zero) > c.room && (c.turn_l - zero * Vec3::UnitZ()).norm() < c.room;
  });
  if (!same) return "";
  if (recording.find("case_heading") == nullptr)
    return fmt::format(
        "{}: the case stood {:.3g} deg off the heading that the plan has, {} North over West, as "
        "the "
        "gimbals show in {} caged position{}: with that put right they have the attitude of the "
        "plan. Write case_heading for each [[plan.position]] ({} deg), those of a preset written "
        "out first, or record a column case_heading",
        recording.source.empty() ? "the recording" : recording.source, std::abs(zero) / detail::deg,
        zero < 0.0 ? "further from" : "less far from", all.size(), all.size() == 1 ? "" : "s",
        headings_text(study, -zero));
  const bool inner = std::ranges::all_of(all, &Caged::inner);
  return fmt::format(
      "{}:case_heading: it reads {:.3g} deg too {}, as the gimbals show in {} caged position{}: "
      "with that put right they have the attitude of the plan. {}Correct it, or write offset = {{ "
      "case_heading = \"{:.4g} deg\" }} in [recording]",
      recording.source.empty() ? "the recording" : recording.source, std::abs(zero) / detail::deg,
      zero > 0.0 ? "much" : "little", all.size(), all.size() == 1 ? "" : "s",
      inner ? "An inner gimbal that reads as much too much looks the same, and so does a platform "
              "that was caged so far off. "
            : "",
      -zero / detail::deg);
}

}  // namespace drift::preparation
