#include "analysis/discovery/settle_noise.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <numeric>

namespace drift::discovery {
namespace {

/// log det (1 + C) of some columns under a noise: what a unit prior on their amplitudes costs twice the
/// log of the marginal likelihood against its maximum.
double price(const LinearProblem& problem, const NoiseModel& noise, const std::vector<int>& columns) {
  LinearProblem part = problem;
  part.extra = problem.extra(Eigen::all, columns);
  const MatX C = Projector(part, noise).candidates().C + MatX::Identity(part.extra.cols(), part.extra.cols());
  const MatX L = Eigen::LLT<MatX>(C).matrixL();
  return 2.0 * L.diagonal().array().log().sum();
}

}  // namespace

std::vector<std::size_t> by_evidence(const Examination& e) {
  std::vector<std::size_t> order(e.scores.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return e.scores[a].log_bayes > e.scores[b].log_bayes;
  });
  std::erase_if(order, [&](std::size_t k) { return e.scores[k].dof == 0; });
  return order;
}

bool settle_noise(Examination& e, const Test& test, double threshold, std::size_t most_tries, int rounds) {
  std::vector<int> in_mean;
  bool replaced = false;
  for (int round = 0; round < rounds && e.noise.driven; ++round) {
    // As seen now, and as seen with no more than the declared noise.
    std::vector<std::pair<std::size_t, std::size_t>> tries;  // candidate, variant
    const auto add_best = [&] {
      std::size_t count = 0;
      for (const std::size_t k : by_evidence(e)) {
        const std::pair<std::size_t, std::size_t> t{k, e.scores[k].variant};
        const auto& columns = e.set.candidates[k].variants[t.second].columns;
        if (std::find(in_mean.begin(), in_mean.end(), columns.front()) != in_mean.end()) continue;
        if (std::find(tries.begin(), tries.end(), t) == tries.end()) tries.push_back(t);
        if (++count == most_tries) break;
      }
    };
    const NoiseEstimate noise_alone = e.noise;
    add_best();
    NoiseEstimate declared;
    declared.model = declared_noise(e.filter);
    set_noise(e, test.timeline, declared);
    add_best();

    const NoiseEstimate reference = estimate_noise(e.problem, declared.model, in_mean);
    NoiseEstimate best = noise_alone;
    double strongest = 0.0;
    std::vector<int> best_mean;
    for (const auto& [k, v] : tries) {
      const auto& columns = e.set.candidates[k].variants[v].columns;
      std::vector<int> mean = in_mean;
      mean.insert(mean.end(), columns.begin(), columns.end());
      const NoiseEstimate with = estimate_noise(e.problem, declared.model, mean);
      const double ratio = with.log_likelihood2 - reference.log_likelihood2 + price(e.problem, with.model, columns);
      const double s = strength(ratio, static_cast<int>(columns.size()));
      if (s <= strongest) continue;
      strongest = s;
      best = with;
      best_mean = mean;
    }
    if (strongest < threshold) {
      set_noise(e, test.timeline, noise_alone);
      break;
    }
    set_noise(e, test.timeline, best);
    in_mean = best_mean;
    replaced = true;
  }
  return replaced;
}

}  // namespace drift::discovery
