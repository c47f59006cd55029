#include "core/estimate/measurements.hpp"

#include <array>
#include <limits>
#include <string>

namespace drift {

Measurements measurements_of(const Recording& recording, const Readout& readout) {
  const auto rows = static_cast<Eigen::Index>(recording.rows());
  const double missing = std::numeric_limits<double>::quiet_NaN();
  Measurements m{Mat3X::Constant(3, rows, missing), Mat3X::Constant(3, rows, missing)};
  const auto fill = [&](Mat3X& into, int axis, const std::string& name) {
    if (const Channel* c = recording.find(name))
      into.row(axis) = Eigen::Map<const Eigen::RowVectorXd>(c->values.data(), rows);
  };
  const std::array<const char*, 3> gimbals{"gimbal_outer", "gimbal_middle", "gimbal_inner"};
  for (int axis = 0; axis < 3; ++axis) {
    if (readout.accelerometers) fill(m.acc, axis, std::string("acc_") + "xyz"[axis]);
    if (readout.gimbals) fill(m.gimbal, axis, gimbals[axis]);
  }
  return m;
}

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
