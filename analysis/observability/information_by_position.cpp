#include "analysis/observability/information_by_position.hpp"

#include "core/estimate/triangle.hpp"

namespace drift::observability {
namespace {

VecX log2_sigma(const Posterior& posterior) {
  return posterior.sigma.array().log2();
}

/// log2 sigma of all parameters with each position left out, shape (n, positions).
MatX log2_sigma_without(const LinearisedPlan& plan) {
  const Eigen::Index n = plan.size();
  MatX all(n, plan.positions);
  if (plan.again) {  // rows that follow know what was measured there
    for (int p = 0; p < plan.positions; ++p)
      all.col(p) = log2_sigma(posterior_of(plan.again(1.0, p)));
    return all;
  }
  // Of each chain what it says of the parameters; of a chain with a position left out, the same.
  std::vector<MatX> roots;
  for (int c = 0; c < plan.chains; ++c)
    roots.push_back(information_root(plan, [&](const TimeBin& bin) { return bin.chain == c; }));
  std::vector<MatX> behind(roots.size() + 1, MatX::Zero(n, n));  // chains from c on
  for (std::size_t c = roots.size(); c-- > 0;)
    behind[c] = triangle(stacked(roots[c], behind[c + 1]));
  MatX ahead = MatX::Zero(n, n);  // chains before c
  std::size_t chain = 0;
  for (int p = 0; p < plan.positions; ++p) {
    int c = -1;
    for (const TimeBin& bin : plan.bins)
      if (bin.position == p) c = bin.chain;
    for (; chain < static_cast<std::size_t>(c); ++chain)
      ahead = triangle(stacked(ahead, roots[chain]));
    const MatX rest = information_root(
        plan, [&](const TimeBin& bin) { return bin.chain == c && bin.position != p; });
    const MatX without = stacked(stacked(ahead, behind[chain + 1]), rest);
    all.col(p) = log2_sigma(posterior_of(triangle(without)));
  }
  return all;
}

}  // namespace

InformationCourse information_course(const LinearisedPlan& plan) {
  const Eigen::Index n = plan.size();
  const auto bins = static_cast<Eigen::Index>(plan.bins.size());
  InformationCourse out;
  out.gain = MatX::Zero(n, bins);
  out.position_gain = MatX::Zero(n, plan.positions);
  out.bits = VecX::Zero(plan.positions);

  InformationSum sum(n);
  VecX before = VecX::Zero(n);
  double bits = 0.0;
  for (Eigen::Index b = 0; b < bins; ++b) {
    const TimeBin& bin = plan.bins[b];
    sum.add(bin.chain, bin.rows);
    const Posterior posterior = posterior_of(sum.root(), bin.walked);
    const VecX after = log2_sigma(posterior);
    out.bits[bin.position] += posterior.bits - bits;
    bits = posterior.bits;
    out.gain.col(b) = before - after;
    out.position_gain.col(bin.position) += out.gain.col(b);
    before = after;
  }

  out.loss = log2_sigma_without(plan).colwise() - before;
  return out;
}

}  // namespace drift::observability
