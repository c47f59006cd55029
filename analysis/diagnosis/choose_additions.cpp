#include "analysis/diagnosis/choose_additions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mc/task/campaign.hpp"

namespace drift::diagnosis {
namespace {

constexpr double least_gain = 1e-3;  // of the mean way to `wanted`
constexpr double all_there = 1.0 - 1e-9;

double duration_of(const planning::Addition& addition) {
  double sum = 0.0;
  for (const Position& p : addition) sum += p.dwell;
  return sum;
}

/// How far pairs are: the mean way to what is wanted, 0 .. 1, and the closest of them [1 sigma].
struct Reached {
  double part = 0.0, closest = 0.0;
};

struct Selection {
  std::vector<std::size_t> additions;
  Reached reached;
  double duration = 0.0;  ///< [s]
};

}  // namespace

std::vector<std::size_t> choose_additions(const Information& start,
                                          const std::vector<planning::Addition>& pool,
                                          const std::vector<Information>& gains, const Told& told,
                                          const ChooseOptions& options) {
  if (told.pairs.empty()) return {};
  const auto reached = [&](const Information& info) {
    Reached r{0.0, HUGE_VAL};
    for (const Separation& s : separations(info, told.alternatives, told.pairs)) {
      r.part += std::min(1.0, s.sigma / options.wanted) / static_cast<double>(told.pairs.size());
      r.closest = std::min(r.closest, s.sigma);
    }
    return r;
  };
  const auto greedy = [&](double thrift) {
    Information now = start;
    Selection made{{}, reached(now)};
    while (made.additions.size() < options.most && made.reached.part < all_there) {
      const auto values = mc::run_campaign(pool.size(), [&](std::size_t k) {
        Information with = now;
        return reached(with += gains[k]);
      });
      std::size_t best = pool.size();
      double most = 0.0;
      for (std::size_t k = 0; k < pool.size(); ++k) {
        const double gain =
            (values[k].part - made.reached.part) / std::pow(duration_of(pool[k]), thrift);
        // Of those that bring as much (all that is wanted, often), the one that sets the closest
        // farthest apart.
        const bool tie = best < pool.size() && std::abs(gain - most) <= 1e-9 * most;
        if (tie ? values[k].closest > values[best].closest : gain > most) {
          best = k;
          most = gain;
        }
      }
      if (best == pool.size() || values[best].part - made.reached.part < least_gain) break;
      made.additions.push_back(best);
      made.reached = values[best];
      made.duration += duration_of(pool[best]);
      now += gains[best];
    }
    return made;
  };
  const Selection thrifty = greedy(1.0), lavish = greedy(0.0);
  const auto there = [&](const Selection& s) { return s.reached.part >= all_there; };
  // A margin that is cheap is taken: the diagnosis that follows knows the noise less well than this
  // does.
  const bool margin = lavish.reached.closest > 2.0 * thrifty.reached.closest &&
                      lavish.duration <= 2.0 * thrifty.duration;
  const bool prefer = there(thrifty) && there(lavish) ? margin || lavish.duration < thrifty.duration
                                                      : lavish.reached.part > thrifty.reached.part;
  return prefer ? lavish.additions : thrifty.additions;
}

}  // namespace drift::diagnosis
