#include "analysis/planning/choose_additions.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/inference/thresholds.hpp"
#include "analysis/planning/greedy.hpp"

namespace drift::planning {
namespace {

using inference::AdviceLimits;
constexpr double all_there = 1.0 - 1e-9;
constexpr double as_much = 1e-9;  // relative difference of gains that counts for nothing

double duration_of(const Addition& addition) {
  double sum = 0.0;
  for (const Position& p : addition) sum += p.dwell;
  return sum;
}

/// How far pairs are: the mean way to what is wanted, 0 .. 1, and the closest of them [1 sigma].
struct Reached {
  double part = 0.0, closest = HUGE_VAL;
};

Reached reached(const Information& info, const Aim& aim) {
  Reached r;
  for (const Separation& s : separations(info, aim.traces, aim.pairs)) {
    r.part += std::min(1.0, s.sigma / aim.wanted) / static_cast<double>(aim.pairs.size());
    r.closest = std::min(r.closest, s.sigma);
  }
  return r;
}

/// Figure of merit of an addition. Of those that bring as much (all that is wanted, often), the one
/// that sets the closest farthest apart is worth more.
struct Merit {
  Reached reached;    ///< with it
  double gain = 0.0;  ///< of part, over its time to the power of thrift
  bool operator<(const Merit& more) const {
    const bool tie = std::abs(more.gain - gain) <= as_much * gain;
    return tie ? reached.closest < more.reached.closest : gain < more.gain;
  }
};

struct Selection {
  std::vector<std::size_t> additions;
  Reached reached;
  double duration = 0.0;  ///< [s]
  bool there() const { return reached.part >= all_there; }
};

Selection select(Information known, const std::vector<Candidate<Information>>& pool, const Aim& aim,
                 double thrift) {
  Selection made{{}, reached(known, aim)};
  take_greedily(
      aim.most, [&] { return made.there() ? 0 : pool.size(); },
      [&](std::size_t k) {
        Information with = known;
        const Reached then = reached(with += pool[k].gain, aim);
        return Merit{then, (then.part - made.reached.part) /
                               std::pow(duration_of(pool[k].positions), thrift)};
      },
      [&](std::size_t k, const Merit& merit) {
        if (merit.reached.part - made.reached.part < AdviceLimits::least_gain) return false;
        made.additions.push_back(k);
        made.reached = merit.reached;
        made.duration += duration_of(pool[k].positions);
        known += pool[k].gain;
        return true;
      });
  return made;
}

}  // namespace

std::vector<std::size_t> choose_additions(const Information& recorded,
                                          const std::vector<Candidate<Information>>& pool,
                                          const Aim& aim) {
  if (aim.pairs.empty()) return {};
  const Selection thrifty = select(recorded, pool, aim, 1.0),
                  lavish = select(recorded, pool, aim, 0.0);
  // A margin that is cheap is taken: the diagnosis that follows knows the noise less well than this
  // does.
  const bool margin = lavish.reached.closest > AdviceLimits::margin * thrifty.reached.closest &&
                      lavish.duration <= AdviceLimits::margin_hours * thrifty.duration;
  const bool prefer = thrifty.there() && lavish.there()
                          ? margin || lavish.duration < thrifty.duration
                          : lavish.reached.part > thrifty.reached.part;
  return prefer ? lavish.additions : thrifty.additions;
}

}  // namespace drift::planning
