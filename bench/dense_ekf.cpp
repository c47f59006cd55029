#include "bench/dense_ekf.hpp"

#include <Eigen/LU>

namespace drift::bench {

DenseCovariance::DenseCovariance(Eigen::Index n, DenseForm form)
    : P(MatX::Identity(n, n)),
      x(VecX::Zero(n)),
      form_(form),
      identity_(MatX::Identity(n, n)),
      I_KH_(n, n),
      work_(n, n),
      PHt_(n, 3),
      K_(n, 3) {}

void DenseCovariance::propagate(const MatX& F, const MatX& Q) {
  work_.noalias() = F * P;
  P.noalias() = work_ * F.transpose();
  P += Q;
}

void DenseCovariance::update(const Vec3& nu, const Mat3N& H, double r) {
  PHt_.noalias() = P * H.transpose();
  const Mat3 S = H * PHt_ + r * Mat3::Identity();
  K_.noalias() = PHt_ * S.inverse();
  x.noalias() += K_ * nu;
  I_KH_ = identity_;
  I_KH_.noalias() -= K_ * H;
  work_.noalias() = I_KH_ * P;
  if (form_ == DenseForm::textbook) {
    P.swap(work_);
  } else {
    P.noalias() = work_ * I_KH_.transpose();
    P.noalias() += (r * K_) * K_.transpose();
  }
}

}  // namespace drift::bench
