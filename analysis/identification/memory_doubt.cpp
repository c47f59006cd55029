#include "analysis/identification/memory_doubt.hpp"

#include "analysis/inference/thresholds.hpp"
#include "core/plan/environment.hpp"
#include "core/sim/simulate.hpp"
#include "mc/study/own_terms_check.hpp"

namespace drift::identification {
namespace {

std::vector<MemoryLeftOut> doubtful(std::vector<MemoryLeftOut> all) {
  std::erase_if(
      all, [](const MemoryLeftOut& one) { return one.part <= inference::RemarkLimits::memory; });
  return all;
}

}  // namespace

std::vector<MemoryLeftOut> memory_doubt(const FilterSpec& filter, const BatchResult& fit,
                                        const Timeline& timeline) {
  return doubtful(memory_left_out(timeline, filter.model(), theta_of(filter, fit), fit.psi0_l));
}

std::vector<MemoryLeftOut> memory_doubt(const mc::Study& study, std::uint64_t run) {
  mc::require_own_terms(study);
  DriftModel model = study.truth.model();
  if (!study.has_truth || study.kind != RecordingKind::platform) return {};
  if (!TermLibrary::remember(model.terms)) return {};
  model.coupling = facts(model.coupling).settles_to;
  Timeline timeline = lay_out(study.plan, study.site);
  set_loop(timeline, study.truth);
  set_environment(timeline, study.environment, study.monte_carlo.seed, run);
  const TruthDraw draw = draw_truth(study.truth, timeline.chains, study.monte_carlo.seed, run);
  return doubtful(memory_left_out(timeline, model, draw.theta, draw.psi0_l));
}

std::vector<MemoryGaps> memory_gaps(const FilterSpec& filter, const BatchResult& fit,
                                    const Timeline& timeline) {
  constexpr double alike = 1.0 - 1e-6;  // of gaps that are alike the first is told
  std::vector<MemoryGaps> all;
  for (const MemoryOverGap& gap :
       memory_over_gaps(timeline, filter.model(), theta_of(filter, fit))) {
    if (1.0 - gap.left <= inference::RemarkLimits::memory) continue;
    if (all.empty() || all.back().widest.term != gap.term) all.push_back({gap, 0});
    MemoryGaps& of_term = all.back();
    ++of_term.count;
    if (gap.left < alike * of_term.widest.left) of_term.widest = gap;
  }
  return all;
}

}  // namespace drift::identification
