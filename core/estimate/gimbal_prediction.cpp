#include "core/estimate/gimbal_prediction.hpp"

#include "core/physics/gimbals.hpp"

namespace drift {

GimbalPrediction predict_gimbals(const Node& node, double heading, const Vec3& phi) {
  const Mat3 R_cl = case_attitude(heading).transpose();
  const Mat3 R_cp = R_cl * (node.R_lr * rotation(phi));
  return {gimbal_angles(R_cp), gimbal_angles_by_rotation(R_cp) * (R_cl * node.R_il.transpose())};
}

}  // namespace drift
