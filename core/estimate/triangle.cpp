#include "core/estimate/triangle.hpp"

#include <Eigen/QR>
#include <algorithm>

namespace drift {

MatX triangle(const MatX& rows) {
  const Eigen::HouseholderQR<MatX> qr(rows);
  const Eigen::Index k = std::min(rows.rows(), rows.cols());
  MatX R = MatX::Zero(rows.cols(), rows.cols());
  R.topRows(k) = qr.matrixQR().topRows(k).triangularView<Eigen::Upper>();
  return R;
}

MatX stacked(const MatX& a, const MatX& b) {
  MatX all(a.rows() + b.rows(), a.cols());
  all << a, b;
  return all;
}

}  // namespace drift
