#include "core/estimate/rest_rate.hpp"

namespace drift {

GimbalPrediction predict_rest_rate(const Interval& interval, const Timeline& timeline,
                                   const Vec3* phi, const IntervalSensitivity& sensitivity) {
  const Vec3 omega_ie_l = timeline.site.omega_ie_l();
  const Mat3 to_end = sensitivity.Phi[interval.node_count() - 1].transpose();
  GimbalPrediction out{Vec3::Zero(), Mat3::Zero()};
  out.H_rate.setZero(3, sensitivity.G[0].cols());
  for (std::size_t k = 0; k < interval.node_count(); ++k) {
    const Node& node = timeline.nodes[interval.first_node + k];
    const NodeJacobian& j = sensitivity.jacobian[k];
    const Mat3 R_pi = (node.R_il * node.R_lr * rotation(phi[k])).transpose();
    const double w = Timeline::mean_weight(interval.substeps, k);
    const Vec3 omega_ie_i = node.R_il * omega_ie_l;
    out.angles += w * R_pi * (j.omega_ip_i - omega_ie_i);
    // An attitude error turns what the platform sees of the Earth's rate: R_pi -> R_pi (I - [psi
    // x]).
    out.H += w * R_pi * (j.A - skew(omega_ie_i)) * sensitivity.Phi[k] * to_end;
    out.H_rate.noalias() += (w * R_pi) * j.B;
  }
  return out;
}

}  // namespace drift
