#include "analysis/inference/evidence.hpp"

#include "analysis/inference/projector.hpp"
#include "core/base/decompose.hpp"

namespace drift::inference {

Evidence evidence_under(const LinearProblem& problem, const CandidateSet& set,
                        const NoiseModel& noise, const std::vector<int>& with) {
  const Projector projector(problem.with_mean(with), noise);
  Evidence out{projector.marginal().log_likelihood2(), {}};
  for (const Candidate& c : set.candidates) {
    Gain best;
    best.dof = static_cast<int>(c.params.size());
    for (std::size_t v = 0; v < c.variants.size(); ++v) {
      const auto [C, g, raw] = projector.candidates(c.variants[v].columns);
      const double ratio = g.dot(Cholesky(C + MatX::Identity(g.size(), g.size())).solve(g));
      if (ratio > best.ratio) {
        best.ratio = ratio;
        best.variant = v;
      }
    }
    out.gains.push_back(best);
  }
  return out;
}

}  // namespace drift::inference
