#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/planning/attitudes.hpp"
#include "core/base/check.hpp"
#include "core/plan/test_plan.hpp"
#include "mc/task/campaign.hpp"

namespace drift::planning {

/// Something that may be added to a plan: positions one after the other.
using Addition = std::vector<Position>;

/// How positions are come to and held, whatever their attitude.
struct Hold {
  Entry entry = Entry::caged;
  double dwell = 0.0, sample = 0.0;                           ///< [s]
  std::vector<std::optional<double>> headings{std::nullopt};  ///< of the case [rad]; empty: as the
                                                              ///< gimbals need
};

/// Every attitude under both command laws at every heading, each as an addition.
std::vector<Addition> held(const std::vector<Attitude>& attitudes, const Hold& hold);

/// What tells apart what a plan has not: every attitude caged, the case at 0 and at 90 deg; those
/// of the cube for three times as long too; and slews from x=N y=W z=U to those of the cube.
std::vector<Addition> position_pool(double usual_dwell, double sample);

/// A position in words, "x=N y=W z=U, level, slewed"; its dwell is said where it is not the usual.
std::string description(const Position& position, double usual_dwell);

/// An addition, and what it tells.
template <class Gain>
struct Candidate {
  Addition positions;
  Gain gain;
};

/// Integrates each addition of a pool: gain_of(addition) says what it tells, InputError that it is
/// impossible, because no heading of the case keeps the middle gimbal small. The possible ones, in
/// their order.
template <class GainOf>
auto integrated(std::vector<Addition> pool, GainOf&& gain_of, int threads = 0) {
  using Gain = decltype(gain_of(pool.front()));
  auto gains = mc::run_campaign(
      pool.size(),
      [&](std::size_t k) -> std::optional<Gain> {
        try {
          return gain_of(pool[k]);
        } catch (const InputError&) {
          return std::nullopt;
        }
      },
      threads);
  std::vector<Candidate<Gain>> possible;
  for (std::size_t k = 0; k < pool.size(); ++k)
    if (gains[k]) possible.push_back({std::move(pool[k]), std::move(*gains[k])});
  return possible;
}

}  // namespace drift::planning
