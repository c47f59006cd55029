#include "core/estimate/compressed/polynomial_projection.hpp"

#include <Eigen/QR>
#include <algorithm>

#include "core/base/decompose.hpp"

namespace drift {
namespace {

/// Legendre polynomials at u, degree 0 on.
VecX legendre(std::size_t count, double u) {
  VecX P(static_cast<Eigen::Index>(count));
  P[0] = 1.0;
  if (count > 1) P[1] = u;
  for (Eigen::Index k = 1; k + 1 < P.size(); ++k) {
    const double n = static_cast<double>(k);
    P[k + 1] = ((2.0 * n + 1.0) * u * P[k] - n * P[k - 1]) / (n + 1.0);
  }
  return P;
}

/// Their means from a to b: (2 k + 1) Int P_k = P_{k+1} - P_{k-1}.
VecX legendre_means(std::size_t count, double a, double b) {
  const VecX at_a = legendre(count + 1, a), at_b = legendre(count + 1, b);
  VecX mean(static_cast<Eigen::Index>(count));
  mean[0] = 1.0;
  for (Eigen::Index k = 1; k < mean.size(); ++k)
    mean[k] = (at_b[k + 1] - at_b[k - 1] - at_a[k + 1] + at_a[k - 1]) /
              ((2.0 * static_cast<double>(k) + 1.0) * (b - a));
  return mean;
}

}  // namespace

MatX legendre_fit(std::size_t count, std::size_t nodes) {
  const auto M = static_cast<Eigen::Index>(nodes);
  MatX V(M, static_cast<Eigen::Index>(count));
  for (Eigen::Index k = 0; k < M; ++k)
    V.row(k) = legendre(count, 2.0 * static_cast<double>(k) / static_cast<double>(M - 1) - 1.0)
                   .transpose();
  return solve_least_squares(V, MatX::Identity(M, M));
}

MatX legendre_integral(const MatX& fit) {
  const auto count = static_cast<std::size_t>(fit.rows());
  MatX I(fit.cols(), fit.rows());
  I.row(0).setZero();
  for (Eigen::Index k = 1; k < I.rows(); ++k) {
    const double u = 2.0 * static_cast<double>(k) / static_cast<double>(I.rows() - 1) - 1.0;
    I.row(k) = (u + 1.0) * legendre_means(count, -1.0, u).transpose();
  }
  return I * fit;
}

PolynomialProjection polynomial_projection(Reading what, std::span<const ReadingTime> readings,
                                           const MatX& fit) {
  const auto N = static_cast<Eigen::Index>(readings.size());
  const auto count = static_cast<std::size_t>(fit.rows());
  MatX V(N, fit.rows());
  for (Eigen::Index i = 0; i < N; ++i) {
    const ReadingTime& r = readings[static_cast<std::size_t>(i)];
    V.row(i) =
        (what == Reading::mean ? legendre_means(count, r.begin, r.end) : legendre(count, r.end))
            .transpose() /
        r.sigma;
  }
  const Eigen::Index rows = std::min(N, fit.rows());
  const Eigen::HouseholderQR<MatX> qr(V);
  const MatX R = qr.matrixQR().topRows(rows).triangularView<Eigen::Upper>();
  return {qr.householderQ() * MatX::Identity(N, rows), R * fit};
}

}  // namespace drift
