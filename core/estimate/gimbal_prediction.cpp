#include "core/estimate/gimbal_prediction.hpp"

#include "core/base/dual.hpp"
#include "core/physics/gimbals.hpp"

namespace drift {

GimbalPrediction predict_gimbals(const Node& node, double heading, const Vec3& phi) {
  using D = Dual<3>;
  const Mat3 R_lp = node.R_lr * rotation(phi);
  const Mat3 R_cl = case_attitude(heading).transpose();
  Vec3T<D> psi_i;
  for (int k = 0; k < 3; ++k) psi_i[k] = D::variable(0.0, k);
  const Vec3T<D> psi_l = node.R_il.transpose().cast<D>() * psi_i;
  Mat3T<D> R = R_lp.cast<D>();
  R += skew(psi_l) * R_lp.cast<D>();
  const Mat3T<D> R_cp = R_cl.cast<D>() * R;
  const Vec3T<D> angles = gimbal_angles(R_cp);
  GimbalPrediction out;
  for (int i = 0; i < 3; ++i) {
    out.angles[i] = angles[i].v;
    for (int k = 0; k < 3; ++k) out.H(i, k) = angles[i].d[k];
  }
  return out;
}

}  // namespace drift
