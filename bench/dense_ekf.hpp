#pragma once

#include "core/base/linalg.hpp"

namespace drift::bench {

/// How the covariance is updated.
enum class DenseForm {
  textbook,  ///< P <- (I - K H) P
  joseph,    ///< P <- (I - K H) P (I - K H)^T + K R K^T
};

/// Extended Kalman filter covariance as in any textbook, over dense matrices: what a general filter
/// library does with n states. Work space is kept, products are written without temporaries.
class DenseCovariance {
 public:
  using Mat3N = Eigen::Matrix<double, 3, Eigen::Dynamic>;
  using MatN3 = Eigen::Matrix<double, Eigen::Dynamic, 3>;

  DenseCovariance(Eigen::Index states, DenseForm form);

  /// P <- F P F^T + Q, shapes (states, states).
  void propagate(const MatX& F, const MatX& Q);
  /// K = P H^T S^-1 with S = H P H^T + r I; x <- x + K nu. H has shape (3, states).
  void update(const Vec3& nu, const Mat3N& H, double r);

  MatX P;
  VecX x;

 private:
  DenseForm form_;
  MatX identity_, I_KH_, work_;
  MatN3 PHt_, K_;
};

}  // namespace drift::bench
