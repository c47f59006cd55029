#pragma once

#include <Eigen/QR>

#include "core/base/linalg.hpp"

namespace drift {

/// The upper triangle R that a QR decomposition leaves of `rows`: R^T R = rows^T rows, to the
/// precision of the rows themselves (their squares would lose half the digits). Square; zero below
/// the last row if there are fewer rows than columns.
inline MatX triangle(const MatX& rows) {
  const Eigen::HouseholderQR<MatX> qr(rows);
  const Eigen::Index k = std::min(rows.rows(), rows.cols());
  MatX R = MatX::Zero(rows.cols(), rows.cols());
  R.topRows(k) = qr.matrixQR().topRows(k).triangularView<Eigen::Upper>();
  return R;
}

/// Rows of a above rows of b.
inline MatX stacked(const MatX& a, const MatX& b) {
  MatX all(a.rows() + b.rows(), a.cols());
  all << a, b;
  return all;
}

}  // namespace drift
