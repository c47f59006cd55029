#include "analysis/preparation/dwell_turn.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/preparation/input_thresholds.hpp"
#include "core/physics/gimbals.hpp"

namespace drift::preparation {

std::vector<Dwell> dwells_of(const Timeline& timeline) {
  std::vector<Dwell> all;
  for (std::size_t k = 0; k < timeline.intervals.size(); ++k) {
    const Interval& i = timeline.intervals[k];
    if (i.slew) continue;
    if (all.empty() || all.back().position != i.position) all.push_back({i.position, {}});
    all.back().rows.push_back(k);
  }
  return all;
}

std::optional<Turn> turn_of(const Dwell& d, const Timeline& timeline, const Measurements& m,
                            const Position& p) {
  const auto whole = [](const Mat3X& values) {
    return [&values](std::size_t k) {
      return values.col(static_cast<Eigen::Index>(k)).array().isFinite().all();
    };
  };
  const auto span = [&](auto&& good) -> std::optional<std::pair<std::size_t, std::size_t>> {
    const auto first = std::ranges::find_if(d.rows, good);
    if (first == d.rows.end()) return std::nullopt;
    std::size_t last = *first;
    for (const std::size_t k : d.rows)
      if (good(k) &&
          timeline.intervals[k].t1 - timeline.intervals[*first].t1 <= PlanLimits::longest_turn)
        last = k;
    if (last == *first) return std::nullopt;
    return std::pair(*first, last);
  };
  const auto column = [](const Mat3X& values, std::size_t k) {
    return Vec3(values.col(static_cast<Eigen::Index>(k)));
  };
  const auto seconds = [&](const auto& s) {
    return timeline.intervals[s->second].t1 - timeline.intervals[s->first].t1;
  };
  if (const auto s = span(whole(m.gimbal))) {
    const auto attitude = [&](std::size_t k) -> Mat3 {
      return case_attitude(timeline.intervals[k].heading1) * gimbal_chain(column(m.gimbal, k));
    };
    return Turn{rotation_vector(attitude(s->second) * attitude(s->first).transpose()) / seconds(s),
                Vec3::Ones()};
  }
  if (const auto s = span(whole(m.acc))) {
    // Up, as the nominal attitude would have it, turns the other way; its turn about itself is not
    // seen.
    const Vec3 a = (p.R_lp * column(m.acc, s->first)).normalized(),
               b = (p.R_lp * column(m.acc, s->second)).normalized();
    const Vec3 axis = a.cross(b);
    const double angle = std::atan2(axis.norm(), a.dot(b));
    const Vec3 turn = axis.norm() > 0.0 ? Vec3(axis.normalized() * angle) : Vec3(Vec3::Zero());
    return Turn{-turn / seconds(s), Vec3(1.0, 1.0, 0.0)};
  }
  return std::nullopt;
}

}  // namespace drift::preparation
