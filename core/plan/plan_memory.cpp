#include "core/plan/plan_memory.hpp"

#include "core/base/memory.hpp"
#include "core/plan/timeline.hpp"

namespace drift {

double memory_of_samples(double samples) {
  // An interval, three nodes at least, and about as much again for what is done along them.
  return 2.0 * samples * static_cast<double>(sizeof(Interval) + 3 * sizeof(Node));
}

void require_memory_for(const TestPlan& plan) {
  double samples = 0.0;
  for (const Position& p : plan.positions) samples += p.dwell / p.sample;
  require_memory(memory_of_samples(samples), ExitCode::config,
                 fmt::format("[plan]: {} positions of {:.0f} samples together",
                             plan.positions.size(), samples),
                 "Make the dwells shorter or `sample` longer");
}

}  // namespace drift
