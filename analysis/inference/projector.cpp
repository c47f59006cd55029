#include "analysis/inference/projector.hpp"

#include <cmath>
#include <utility>

#include "core/base/decompose.hpp"

namespace drift::inference {
namespace {

MatX side_by_side(const LinearProblem& p) {
  MatX all(p.rows(), p.theta.cols() + p.extra.cols() + 1);
  all << p.theta, p.extra, p.r0;
  return all;
}

/// a'a - h'h.
MatX information(const Eigen::Ref<const MatX>& a, const Eigen::Ref<const MatX>& h) {
  MatX C = MatX::Zero(a.cols(), a.cols());
  C.selfadjointView<Eigen::Lower>().rankUpdate(a.transpose());
  C.selfadjointView<Eigen::Lower>().rankUpdate(h.transpose(), -1.0);
  C.triangularView<Eigen::StrictlyUpper>() = C.transpose();
  return C;
}

}  // namespace

Projector::Projector(const LinearProblem& problem, const NoiseModel& noise)
    : whitener_(problem, noise),
      n_(problem.theta.cols()),
      white_(whitener_.apply(side_by_side(problem))) {
  MatX A = MatX::Identity(n_, n_);
  A.selfadjointView<Eigen::Lower>().rankUpdate(theta().transpose());
  L_ = Cholesky(A).L();
  half_ = h(white_.rightCols(white_.cols() - n_), 0);
  marginal_.chi2 = r0().squaredNorm() - half_.rightCols<1>().squaredNorm();
  marginal_.log_det = whitener_.log_det() + 2.0 * L_.diagonal().array().log().sum();
  marginal_.rows = white_.rows();
}

MatX Projector::h(const Eigen::Ref<const MatX>& whitened, Eigen::Index first) const {
  MatX out = theta().middleRows(first, whitened.rows()).transpose() * whitened;
  L_.triangularView<Eigen::Lower>().solveInPlace(out);
  return out;
}

Projected Projector::candidates() const {
  const auto half = half_.leftCols(extra().cols());
  return {information(extra(), half),
          extra().transpose() * r0() - half.transpose() * half_.rightCols<1>(),
          extra().colwise().squaredNorm().transpose()};
}

Projected Projector::candidates_in(const std::vector<std::vector<int>>& groups) const {
  const auto half = half_.leftCols(extra().cols());
  Projected out{MatX::Constant(extra().cols(), extra().cols(), std::nan("")),
                extra().transpose() * r0() - half.transpose() * half_.rightCols<1>(),
                extra().colwise().squaredNorm().transpose()};
  for (const std::vector<int>& group : groups)
    out.C(group, group) = information(extra()(Eigen::all, group), half_(Eigen::all, group));
  return out;
}

Projected Projector::candidates(const std::vector<int>& columns) const {
  const MatX S = extra()(Eigen::all, columns), half = half_(Eigen::all, columns);
  return {information(S, half), S.transpose() * r0() - half.transpose() * half_.rightCols<1>(),
          S.colwise().squaredNorm().transpose()};
}

Projector::Scan Projector::scanned(const MatX& white, const MatX& half, Eigen::Index first) const {
  return {information(white, half), MatX(white.cols(), 0),
          white.transpose() * r0().segment(first, white.rows()) -
              half.transpose() * half_.rightCols<1>(),
          white.colwise().squaredNorm().transpose()};
}

Projector::Scan Projector::scan(const MatX& columns, Eigen::Index first) const {
  const MatX white = whitener_.apply(columns, first), half = h(white, first);
  Scan out = scanned(white, half, first);
  out.cross = white.transpose() * extra().middleRows(first, white.rows()) -
              half.transpose() * half_.leftCols(extra().cols());
  return out;
}

Projector::Scan Projector::scan_alone(const MatX& columns, Eigen::Index first) const {
  const MatX white = whitener_.apply(columns, first);
  return scanned(white, h(white, first), first);
}

Projector::Replay Projector::replay(const MatX& recordings) const {
  const MatX white = whitener_.apply(recordings), half = h(white, 0);
  const Eigen::Index K = extra().cols();
  const VecX chi2 = (white.colwise().squaredNorm() - half.colwise().squaredNorm()).transpose();
  return {-(chi2.array() + marginal_.log_det),
          extra().transpose() * white - half_.leftCols(K).transpose() * half};
}

MatX Projector::clean(const Eigen::Ref<const MatX>& whitened) const {
  MatX x = h(whitened, 0);
  L_.transpose().triangularView<Eigen::Upper>().solveInPlace(x);
  return whitened - theta() * x;
}

void Projector::forget_candidates() {
  MatX kept(white_.rows(), n_ + 1);
  kept << theta(), r0();
  white_ = std::move(kept);
  half_ = MatX(half_.rightCols<1>());
}

Projector::Fit Projector::fit() const {
  MatX inverse = MatX::Identity(n_, n_);  // of L
  L_.triangularView<Eigen::Lower>().solveInPlace(inverse);
  return {inverse.transpose() * half_.rightCols<1>(), inverse.transpose() * inverse};
}

}  // namespace drift::inference
