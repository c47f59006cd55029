#include "core/estimate/linearizer.hpp"

namespace drift {
namespace {

using D3 = Dual<3>;

/// Derivative number k of three duals.
Vec3 derivative(const Vec3T<D3>& d, int k) {
  return {d[0].d[k], d[1].d[k], d[2].d[k]};
}

/// d (R(delta)^T f) / d delta, columns x, y, z.
Mat3 by_offset(const Vec3& delta_p, const Vec3& f_p) {
  Vec3T<D3> delta;
  for (int k = 0; k < 3; ++k) delta[k] = D3::variable(delta_p[k], k);
  const Vec3T<D3> f = rotation(delta).transpose() * f_p.cast<D3>();
  Mat3 J;
  for (int k = 0; k < 3; ++k) J.col(k) = derivative(f, k);
  return J;
}

}  // namespace

/// Rotation by the terms that offset the attitude, with derivatives with respect to psi.
Linearizer::Vec3D Linearizer::offset() const {
  OffsetHook::Assembly<D3> sum;
  offsets_.add_to(seen_, sum);
  return sum.delta_p;
}

/// The readout where terms turn the platform between what the gyros hold and what is read.
void Linearizer::differentiate_offset_readout(const Mat3& R_il, NodeJacobian& out) {
  const auto sigma = [&](std::size_t state) {
    return layout_.sigma[static_cast<Eigen::Index>(layout_.num_rate + state)];
  };
  SeenByTerms<double> seen = seen_;
  const Vec3D delta_p = offset();
  seen.at_psi.f_p = rotation(delta_p).transpose() * seen_.at_psi.f_p;
  for (int i = 0; i < 3; ++i) seen.still.f_p[i] = seen.at_psi.f_p[i].v;
  const auto outputs = [&] {
    ReadoutHook::Assembly<D3> sum;
    sum.acc = seen.at_psi.f_p;
    offset_accelerometers_.add_to(seen, sum);
    return sum.acc;
  };
  const Vec3D acc = outputs();
  Mat3 H_l;
  for (int i = 0; i < 3; ++i) {
    out.acc[i] = acc[i].v;
    for (int k = 0; k < 3; ++k) H_l(i, k) = acc[i].d[k];
  }
  out.H = H_l * R_il.transpose();

  offset_accelerometers_.differentiate(seen, derivative_.data());
  for (std::size_t e = 0; e < offset_accelerometers_.entries().size(); ++e) {
    const auto [state, axis] = offset_accelerometers_.entries()[e];
    out.H_par(axis, static_cast<Eigen::Index>(state)) = derivative_[e] * sigma(state);
  }
  // The states that turn the platform: through the specific force that the accelerometers feel.
  for (int i = 0; i < 3; ++i) seen.at_psi.f_p[i] = D3::variable(seen.still.f_p[i], i);
  const Vec3D by_force = outputs();
  Mat3 D;
  for (int k = 0; k < 3; ++k) D.col(k) = derivative(by_force, k);
  const Mat3 J = D * by_offset({delta_p[0].v, delta_p[1].v, delta_p[2].v}, seen_.still.f_p);
  offsets_.differentiate(seen_, derivative_.data());
  for (const auto& [state, axis] : offsets_.entries())
    out.H_par.col(static_cast<Eigen::Index>(state)).setZero();
  for (std::size_t e = 0; e < offsets_.entries().size(); ++e) {
    const auto [state, axis] = offsets_.entries()[e];
    out.H_par.col(static_cast<Eigen::Index>(state)) +=
        J.col(axis) * (derivative_[e] * sigma(state));
  }
}

GimbalPrediction Linearizer::gimbals(const Timeline& timeline, const NodePoint& point) {
  const Node& node = *point.node;
  const Interval& interval = *point.interval;
  const Vec3& phi = point.phi;
  if (!offsets_.any() && !resolvers_.any()) return predict_gimbals(node, interval.heading1, phi);
  const Mat3 R_lp = node.R_lr * rotation(phi);
  look(point, R_lp, &timeline);
  if (needs_.own_rate) {
    around_still_.memory = seen_.memory;
    around_still_.omega_drift_p = around_at_psi_.omega_drift_p = drift_rate(
        model_, seen_.still, theta_.data(), misalignment_matrix(model_.mounting, interval.loop));
  }
  GimbalAssembly<D3> sum;
  resolvers_.add_to(seen_, sum);
  const Vec3D delta_p = offset();
  const Mat3 R_cl = case_attitude(interval.heading1).transpose();
  const auto angles_of = [&](const Vec3D& tilt_l, const Mat3T<D3>& R, const Vec3D& delta) {
    const Mat3T<D3> R_tp = rotation(tilt_l).transpose() * R * rotation(delta);
    return gimbal_angles<D3>(R_cl.cast<D3>() * R_tp);
  };
  const Vec3D angles = angles_of(sum.case_tilt_l, R_at_psi_, delta_p);
  GimbalPrediction out;
  Mat3 H_l;
  for (int a = 0; a < 3; ++a) {
    out.angles[a] = angles[a].v + sum.error[a].v;
    for (int k = 0; k < 3; ++k) H_l(a, k) = angles[a].d[k] + sum.error[a].d[k];
  }
  out.H = H_l * node.R_il.transpose();

  // Where one of the two small rotations is the variable.
  Vec3D tilt_still, delta_still, tilt_variable, delta_variable;
  for (int k = 0; k < 3; ++k) {
    tilt_still[k] = D3(sum.case_tilt_l[k].v);
    delta_still[k] = D3(delta_p[k].v);
    tilt_variable[k] = D3::variable(sum.case_tilt_l[k].v, k);
    delta_variable[k] = D3::variable(delta_p[k].v, k);
  }
  const Mat3T<D3> R_still = R_lp.cast<D3>();
  const Vec3D by_tilt = angles_of(tilt_variable, R_still, delta_still);
  const Vec3D by_delta = angles_of(tilt_still, R_still, delta_variable);

  out.H_par = padded_rows(layout_.size() - layout_.num_rate);
  const auto add = [&](std::size_t state, const Vec3& d) {
    const auto k = static_cast<Eigen::Index>(state);
    out.H_par.col(k) += d * layout_.sigma[static_cast<Eigen::Index>(layout_.num_rate) + k];
  };
  resolvers_.differentiate(seen_, derivative_.data());
  for (std::size_t e = 0; e < resolvers_.entries().size(); ++e) {
    const auto [state, at] = resolvers_.entries()[e];
    add(state, derivative_[e] * (at < 3 ? Vec3(Vec3::Unit(at)) : derivative(by_tilt, at - 3)));
  }
  offsets_.differentiate(seen_, derivative_.data());
  for (std::size_t e = 0; e < offsets_.entries().size(); ++e) {
    const auto [state, axis] = offsets_.entries()[e];
    add(state, derivative_[e] * derivative(by_delta, axis));
  }
  return out;
}

}  // namespace drift
