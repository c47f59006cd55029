#include "analysis/inference/evidence.hpp"

#include <Eigen/Cholesky>

#include "analysis/inference/whitener.hpp"

namespace drift::inference {

Evidence evidence_under(const LinearProblem& problem, const CandidateSet& set,
                        const NoiseModel& noise, const std::vector<int>& with) {
  const Eigen::Index m = problem.theta.cols(), n = m + static_cast<Eigen::Index>(with.size()),
                     K = problem.extra.cols();
  MatX all(problem.rows(), n + K + 1);
  all << problem.theta, problem.extra(Eigen::all, with), problem.extra, problem.r0;
  const Whitener whitener(problem, noise);
  all = whitener.apply(all);

  const auto theta = all.leftCols(n);
  MatX A = MatX::Identity(n, n);
  A.selfadjointView<Eigen::Lower>().rankUpdate(theta.transpose());
  const MatX L = Eigen::LLT<MatX, Eigen::Lower>(A).matrixL();
  MatX half = theta.transpose() * all.rightCols(K + 1);
  L.triangularView<Eigen::Lower>().solveInPlace(half);

  const auto r = all.col(n + K);
  Evidence out;
  out.log_likelihood2 = half.col(K).squaredNorm() - r.squaredNorm() - whitener.log_det() -
                        2.0 * L.diagonal().array().log().sum();
  const VecX g = all.middleCols(n, K).transpose() * r - half.leftCols(K).transpose() * half.col(K);
  for (const Candidate& c : set.candidates) {
    Gain best;
    best.dof = static_cast<int>(c.params.size());
    for (std::size_t v = 0; v < c.variants.size(); ++v) {
      const auto& columns = c.variants[v].columns;
      const auto size = static_cast<Eigen::Index>(columns.size());
      MatX C(size, size);
      VecX part(size);
      for (Eigen::Index i = 0; i < size; ++i) {
        part[i] = g[columns[i]];
        for (Eigen::Index k = 0; k <= i; ++k)
          C(i, k) = C(k, i) = all.col(n + columns[i]).dot(all.col(n + columns[k])) -
                              half.col(columns[i]).dot(half.col(columns[k])) + (i == k ? 1.0 : 0.0);
      }
      const double ratio = part.dot(C.llt().solve(part));
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
