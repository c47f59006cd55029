// A platform test from C++: simulated, its parameters estimated, the plan ranked.
#include <fmt/core.h>

#include "analysis/planning/rank.hpp"
#include "core/estimate/batch.hpp"
#include "core/sim/simulate.hpp"
#include "mc/study/study.hpp"

int main(int argc, char** argv) try {
  using namespace drift;
  if (argc != 2) throw std::runtime_error("usage: example STUDY.toml");
  const mc::Study study = mc::read_study(argv[1], {});
  const FilterSpec& filter = study.filters.front();

  const Timeline timeline = lay_out(study.plan, study.site);
  Simulator simulator(study.truth, study.readout);
  const Simulation test = simulator.run(timeline, study.monte_carlo.seed, 0);

  const BatchResult fit =
      fit_batch(filter, {timeline, study.readout, test.measured}, make_layout(filter).theta);
  for (const ParameterEstimate& p : fit.estimate.parameters) {
    const auto& [key, unit] =
        std::pair(TermLibrary::specs[p.param].key, TermLibrary::specs[p.param].unit);
    fmt::print("{:<8} {:9.3f} +- {:.3f} {}, truth {:.3f}\n", key.view(), p.value / unit.to_si,
               p.sigma / unit.to_si, unit.symbol.view(), test.draw.theta[p.param] / unit.to_si);
  }

  const auto ranked = planning::rank_plan(study, {});
  fmt::print("chi-square per degree {:.3f}; the plan says {:.1f} bits\n",
             fit.estimate.statistic_per_dof(), ranked.groups.front().models.front().ranking.bits);
} catch (const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}
