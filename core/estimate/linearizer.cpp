#include "core/estimate/linearizer.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "core/base/check.hpp"

namespace drift {
namespace {

using D3 = Dual<3>;

std::vector<std::size_t> rate_states(const Layout& layout) {
  return {layout.params.begin(),
          layout.params.begin() + static_cast<std::ptrdiff_t>(layout.num_rate)};
}
std::vector<std::size_t> readout_states(const Layout& layout) {
  return {layout.params.begin() + static_cast<std::ptrdiff_t>(layout.num_rate),
          layout.params.end()};
}

/// Derivative number k of a row of duals.
template <class Duals>
Vec3 derivative(const Duals& d, int first, int k) {
  return {d[first].d[k], d[first + 1].d[k], d[first + 2].d[k]};
}

/// d (R(delta)^T f) / d delta, columns x, y, z.
Mat3 by_offset(const Vec3& delta_p, const Vec3& f_p) {
  Vec3T<D3> delta;
  for (int k = 0; k < 3; ++k) delta[k] = D3::variable(delta_p[k], k);
  const Vec3T<D3> f = rotation(delta).transpose() * f_p.cast<D3>();
  Mat3 J;
  for (int k = 0; k < 3; ++k) J.col(k) = derivative(f, 0, k);
  return J;
}

/// The misalignment that the loop closes over, K = share E + fixed (drift_model.hpp).
struct Closure {
  double share = 0.0;
  bool varies = false;  ///< the share is the slot lambda
  Mat3 K = Mat3::Zero();
};

Closure closure_of(Coupling coupling, const Mat3& E, double lambda, const Mat3& E_loop) {
  switch (coupling) {
    case Coupling::eq6:
      return {1.0, false, E};
    case Coupling::lambda:
      return {lambda, true, lambda * E};
    case Coupling::compensated:
      return {0.0, false, E_loop};
    case Coupling::eq5:
    case Coupling::servo:
      break;
  }
  return {};
}

}  // namespace

Linearizer::Linearizer(const DriftModel& model, const Layout& layout, Readout readout)
    : model_(model),
      layout_(layout),
      readout_(readout),
      with_readout_(readout.accelerometers),
      needs_(TermLibrary::needs(model.terms)),
      theta_(layout.theta),
      rates_(model.terms, rate_states(layout)),
      offsets_(model.terms, readout_states(layout)),
      accelerometers_(model.terms, readout_states(layout)),
      resolvers_(model.terms, readout_states(layout)) {
  derivative_.resize(std::max({rates_.entries().size(), offsets_.entries().size(),
                               accelerometers_.entries().size(), resolvers_.entries().size()}));
}

NodeJacobian Linearizer::make() const {
  NodeJacobian j;
  j.A.setZero();
  j.B = Mat3X::Zero(3, layout_.num_rate);
  j.acc.setZero();
  j.H.setZero();
  j.H_par = Mat3X::Zero(3, layout_.size() - layout_.num_rate);
  return j;
}

/// Works out what the terms see at an attitude. What the base terms see is linear in R_lp, so its
/// derivative is what they would see of dR_lp.
void Linearizer::look(const Node& node, const Interval& interval, const Mat3& R_lp,
                      const Timeline* timeline, const MemoryPoint* memory) {
  const auto seen = [&](const Mat3& R) {
    return inputs_at<double>(node.omega_ic_l, interval.omega_cmd_p, model_.mounting, R);
  };
  Inputs<double>& still = seen_.still;
  Inputs<D3>& at_psi = seen_.at_psi;
  still = seen(R_lp);
  at_psi.mounting = still.mounting;
  at_psi.f_p = still.f_p.cast<D3>();
  at_psi.omega_ic_p = still.omega_ic_p.cast<D3>();
  at_psi.omega_cmd_p = still.omega_cmd_p;
  R_at_psi_ = R_lp.cast<D3>();
  for (int k = 0; k < 3; ++k) {  // exp([psi x]) R at psi = 0, to first order
    const Mat3 dR_lp = skew<double>(Vec3::Unit(k)) * R_lp;
    const Inputs<double> d = seen(dR_lp);
    for (int i = 0; i < 3; ++i) {
      at_psi.f_p[i].d[k] = d.f_p[i];
      at_psi.omega_ic_p[i].d[k] = d.omega_ic_p[i];
    }
    for (int i = 0; i < 9; ++i) R_at_psi_.data()[i].d[k] = dR_lp.data()[i];
  }
  seen_.theta = theta_.data();
  if (!needs_.any()) return;
  DRIFT_DEMAND(timeline != nullptr && (memory != nullptr || !needs_.memory));
  const Moment now = moment_at(*timeline, interval, node.t);
  if (needs_.memory) {
    seen_.memory = memory->value.data();
    seen_.memory_derivative = memory->derivative.data();
  }
  Needs shown = needs_;  // memory comes with the hook
  shown.memory = false;
  fill_surroundings<double>(shown, now, R_lp, nullptr, around_still_);
  fill_surroundings<D3>(shown, now, R_at_psi_, nullptr, around_at_psi_);
  still.around = &around_still_;
  at_psi.around = &around_at_psi_;
}

void Linearizer::evaluate(const Node& node, const Interval& interval, const Mat3& E_loop,
                          const Vec3& phi, const Timeline* timeline, const MemoryPoint* memory,
                          NodeJacobian& out) {
  const Mat3 R_lp = node.R_lr * rotation(phi);
  look(node, interval, R_lp, timeline, memory);
  differentiate_rate(E_loop, node.R_il * R_lp, node.R_il, out);
  if (with_readout_) differentiate_readout(node.R_il, out);
}

/// w_ip = w_o - v with (I + K) v = (E - K) w_ic + u (drift_model.hpp), so
///   dw_ip = dw_o - (I + K)^-1 (dE l - dshare E (w_ic + v) + (E - K) dw_ic + du),
///   l = (1 - share) w_ic - share v,  K = share E  (or fixed, then share = 0).
void Linearizer::differentiate_rate(const Mat3& E_loop, const Mat3& R_ip, const Mat3& R_il,
                                    NodeJacobian& out) {
  using H = RatesHook;
  RateAssembly<D3> sum;
  rates_.add_to(seen_, sum);
  const Vec3T<D3> u = sum.omega_drift_g + sum.omega_torque_g;
  Mat3 E;
  for (int i = 0; i < 9; ++i) E.data()[i] = sum.E_gp.data()[i].v;
  const Closure closure = closure_of(model_.coupling, E, sum.lambda.v, E_loop);
  const Mat3 open = E - closure.K;
  const Mat3 minus_closed = -(Mat3::Identity() + closure.K).inverse();
  const Vec3& w = seen_.still.omega_ic_p;
  const Vec3 torqued = Vec3(u[0].v, u[1].v, u[2].v) - seen_.still.omega_cmd_p;
  const Vec3 v = -(minus_closed * (open * w + torqued));
  const Vec3 lever = (1.0 - closure.share) * w - closure.share * v;
  const Vec3 by_share = closure.varies ? Vec3(-(E * (w + v))) : Vec3::Zero();

  Mat3 A_l;
  for (int k = 0; k < 3; ++k) {
    const Vec3 dw = derivative(seen_.at_psi.omega_ic_p, 0, k);
    Vec3 ds = open * dw + derivative(u, 0, k) + by_share * sum.lambda.d[k];
    for (int c = 0; c < 3; ++c) ds += derivative(sum.E_gp.data(), H::E(0, c), k) * lever[c];
    A_l.col(k) = derivative(sum.omega_ip_p, 0, k) + minus_closed * ds;
  }
  out.A = R_ip * A_l * R_il.transpose();
  out.omega_ip_i = R_ip * (Vec3(sum.omega_ip_p[0].v, sum.omega_ip_p[1].v, sum.omega_ip_p[2].v) - v);

  rates_.differentiate(seen_, derivative_.data());
  const Mat3 by_gyro = R_ip * minus_closed;
  const Vec3 share_i = by_gyro * by_share;
  std::size_t before = layout_.size();
  for (std::size_t e = 0; e < rates_.entries().size(); ++e) {
    const auto [state, at] = rates_.entries()[e];
    const double d = derivative_[e] * layout_.sigma[static_cast<Eigen::Index>(state)];
    Vec3 column;
    if (at < H::u(0))
      column = by_gyro.col(at % 3) * (d * lever[at / 3]);
    else if (at < H::omega(0))
      column = by_gyro.col(at - H::u(0)) * d;
    else if (at < H::lambda)
      column = R_ip.col(at - H::omega(0)) * d;
    else
      column = share_i * d;
    auto into = out.B.col(static_cast<Eigen::Index>(state));
    if (state == before)
      into += column;
    else
      into = column;
    before = state;
  }
}

/// Rotation by the terms that offset the attitude, with derivatives with respect to psi.
Linearizer::Vec3D Linearizer::offset() const {
  OffsetHook::Assembly<D3> sum;
  offsets_.add_to(seen_, sum);
  return sum.delta_p;
}

void Linearizer::differentiate_readout(const Mat3& R_il, NodeJacobian& out) {
  const auto sigma = [&](std::size_t state) {
    return layout_.sigma[static_cast<Eigen::Index>(layout_.num_rate + state)];
  };
  SeenByTerms<double> seen = seen_;
  Vec3D delta_p;
  if (offsets_.any()) {
    delta_p = offset();
    seen.at_psi.f_p = rotation(delta_p).transpose() * seen_.at_psi.f_p;
    for (int i = 0; i < 3; ++i) seen.still.f_p[i] = seen.at_psi.f_p[i].v;
  }
  const auto outputs = [&] {
    ReadoutHook::Assembly<D3> sum;
    sum.acc = seen.at_psi.f_p;
    accelerometers_.add_to(seen, sum);
    return sum.acc;
  };
  const Vec3D acc = outputs();
  Mat3 H_l;
  for (int i = 0; i < 3; ++i) {
    out.acc[i] = acc[i].v;
    for (int k = 0; k < 3; ++k) H_l(i, k) = acc[i].d[k];
  }
  out.H = H_l * R_il.transpose();

  accelerometers_.differentiate(seen, derivative_.data());
  for (std::size_t e = 0; e < accelerometers_.entries().size(); ++e) {
    const auto [state, axis] = accelerometers_.entries()[e];
    out.H_par(axis, static_cast<Eigen::Index>(state)) = derivative_[e] * sigma(state);
  }
  if (offsets_.entries().empty()) return;
  // The states that turn the platform: through the specific force that the accelerometers feel.
  for (int i = 0; i < 3; ++i) seen.at_psi.f_p[i] = D3::variable(seen.still.f_p[i], i);
  const Vec3D by_force = outputs();
  Mat3 D;
  for (int k = 0; k < 3; ++k) D.col(k) = derivative(by_force, 0, k);
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

GimbalPrediction Linearizer::gimbals(const Timeline& timeline, const Interval& interval,
                                     const Vec3& phi, const MemoryPoint* memory) {
  const Node& node = timeline.nodes[interval.last_node()];
  if (!offsets_.any() && !resolvers_.any()) return predict_gimbals(node, interval.heading1, phi);
  const Mat3 R_lp = node.R_lr * rotation(phi);
  look(node, interval, R_lp, &timeline, memory);
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

  out.H_par = Mat3X::Zero(3, layout_.size() - layout_.num_rate);
  const auto add = [&](std::size_t state, const Vec3& d) {
    const auto k = static_cast<Eigen::Index>(state);
    out.H_par.col(k) += d * layout_.sigma[static_cast<Eigen::Index>(layout_.num_rate) + k];
  };
  resolvers_.differentiate(seen_, derivative_.data());
  for (std::size_t e = 0; e < resolvers_.entries().size(); ++e) {
    const auto [state, at] = resolvers_.entries()[e];
    add(state, derivative_[e] * (at < 3 ? Vec3(Vec3::Unit(at)) : derivative(by_tilt, 0, at - 3)));
  }
  offsets_.differentiate(seen_, derivative_.data());
  for (std::size_t e = 0; e < offsets_.entries().size(); ++e) {
    const auto [state, axis] = offsets_.entries()[e];
    add(state, derivative_[e] * derivative(by_delta, 0, axis));
  }
  return out;
}

}  // namespace drift
