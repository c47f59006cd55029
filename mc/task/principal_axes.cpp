#include "mc/task/principal_axes.hpp"

#include <cmath>
#include <limits>

namespace drift::mc {
namespace {

/// v <- Q^T v for A = Q T Q^T: the Householder reflections one after the other.
void turn_by_reflections(const Eigen::Tridiagonalization<MatX>& A, VecX& v) {
  const MatX& packed = A.packedMatrix();
  const Eigen::Index n = v.size();
  for (Eigen::Index i = 0; i + 2 < n; ++i) {
    // The reflecting vector is (1, column i below the subdiagonal); of length zero there, none.
    const auto below = packed.col(i).tail(n - i - 2);
    const double square = below.squaredNorm();
    if (square == 0.0) continue;
    const double d = 2.0 / (1.0 + square) * (v[i + 1] + below.dot(v.tail(n - i - 2)));
    v[i + 1] -= d;
    v.tail(n - i - 2) -= d * below;
  }
}

}  // namespace

/// One implicit QR step with Wilkinson's shift on the rows start to end, none of which stands apart
/// (Golub and Van Loan, Matrix Computations, 8.3.2).
void PrincipalAxes::step(Eigen::Index start, Eigen::Index end) {
  VecX& d = variance_;
  VecX& e = beside_;
  const double half = 0.5 * (d[end - 1] - d[end]), last = e[end - 1];
  const double shift =
      d[end] - last * (last / (half + std::copysign(std::hypot(half, last), half)));
  double x = d[start] - shift, z = e[start];
  for (Eigen::Index k = start; k < end; ++k) {
    const double r = std::sqrt(x * x + z * z);
    if (r == 0.0) return;
    const double c = x / r, s = z / r;
    if (k > start) e[k - 1] = r;
    const double p = d[k], q = d[k + 1], o = e[k];
    const double mixed = 2.0 * c * s * o;
    d[k] = c * c * p + mixed + s * s * q;
    d[k + 1] = s * s * p - mixed + c * c * q;
    e[k] = c * s * (q - p) + (c * c - s * s) * o;
    const double a = along_[k], b = along_[k + 1];
    along_[k] = c * a + s * b;
    along_[k + 1] = c * b - s * a;
    if (k + 1 == end) return;
    x = e[k];
    z = s * e[k + 1];
    e[k + 1] *= c;
  }
}

bool PrincipalAxes::diagonalise(const VecX& v) {
  variance_ = tridiagonal_.diagonal();
  const Eigen::Index n = variance_.size();
  beside_.head(n - 1) = tridiagonal_.subDiagonal();
  along_ = v;
  turn_by_reflections(tridiagonal_, along_);
  constexpr double eps = std::numeric_limits<double>::epsilon();
  constexpr int most_steps = 30;  // per variance; two are usual
  Eigen::Index left = most_steps * n;
  for (Eigen::Index end = n - 1; end > 0;) {
    const auto apart = [&](Eigen::Index k) {
      return std::abs(beside_[k]) <= eps * (std::abs(variance_[k]) + std::abs(variance_[k + 1]));
    };
    if (apart(end - 1)) {
      --end;
      continue;
    }
    Eigen::Index start = end - 1;
    while (start > 0 && !apart(start - 1)) --start;
    if (--left < 0) return false;
    step(start, end);
  }
  return true;
}

}  // namespace drift::mc
