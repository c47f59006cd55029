#include "core/estimate/sequential/in_lanes/lane_linearizer.hpp"

#include <algorithm>

#include "core/estimate/rate_chain.hpp"
#include "core/physics/earth.hpp"
#include "core/physics/gimbals.hpp"
#include "core/sim/kinematics.hpp"
#include "core/sim/surroundings.hpp"

namespace drift {
namespace {

std::vector<std::size_t> part_of(const Layout& layout, std::size_t first, std::size_t end) {
  return {layout.params.begin() + static_cast<std::ptrdiff_t>(first),
          layout.params.begin() + static_cast<std::ptrdiff_t>(end)};
}

PackVec cross(const Vec3& a, const PackVec& b) {
  return {Pack(a[1]) * b[2] - Pack(a[2]) * b[1], Pack(a[2]) * b[0] - Pack(a[0]) * b[2],
          Pack(a[0]) * b[1] - Pack(a[1]) * b[0]};
}

PackVec plus(const PackVec& a, double factor, const PackVec& b) {
  PackVec sum;
  for (int i = 0; i < 3; ++i) sum[i] = mul_add(Pack(factor), b[i], a[i]);
  return sum;
}

}  // namespace

LaneLinearizer::LaneLinearizer(const DriftModel& model, const Layout& layout, Readout readout)
    : model_(model),
      needs_(TermLibrary::needs(model.terms)),
      layout_(layout),
      readout_(readout),
      theta_(TermLibrary::num_params),
      rates_(model.terms, model.mounting, part_of(layout, 0, layout.num_rate)),
      accelerometers_(model.terms, model.mounting, part_of(layout, layout.num_rate, layout.size())),
      derivative_(std::max(rates_.entries().size(), accelerometers_.entries().size())) {
  for (std::size_t k = 0; k < theta_.size(); ++k)
    theta_[k] = Pack(layout.theta[static_cast<Eigen::Index>(k)]);
  seen_.still.mounting = seen_.at_psi.mounting = &model_.mounting;
  seen_.theta = theta_.data();
}

LaneJacobian LaneLinearizer::make() const {
  LaneJacobian j;
  j.B.assign(3 * layout_.num_rate, Pack(0.0));
  j.H_par.assign(readout().size(), Pack(0.0));
  return j;
}

/// What the base terms see is linear in R_lp, so its derivative is what they would see of
/// dR_lp = [psi x] R_lp.
void LaneLinearizer::look(const Timeline& timeline, const Node& node, const Interval& interval,
                          const PackVec& phi) {
  R_lp_ = times(in_all_lanes(node.R_lr), rotation(phi));
  const Vec3& w_l = node.omega_ic_l;
  Inputs<Pack>& still = seen_.still;
  Inputs<Dual<3, Pack>>& at_psi = seen_.at_psi;
  still.omega_cmd_p = at_psi.omega_cmd_p = interval.omega_cmd_p;
  for (int i = 0; i < 3; ++i) {
    still.f_p[i] = at_psi.f_p[i].v = R_lp_(2, i);
    still.omega_ic_p[i] = at_psi.omega_ic_p[i].v =
        mul_add(R_lp_(0, i), w_l[0], mul_add(R_lp_(1, i), w_l[1], R_lp_(2, i) * Pack(w_l[2])));
    for (int k = 0; k < 3; ++k) {
      const int a = (k + 1) % 3, b = (k + 2) % 3;
      at_psi.omega_ic_p[i].d[k] = R_lp_(a, i) * Pack(w_l[b]) - R_lp_(b, i) * Pack(w_l[a]);
      at_psi.f_p[i].d[k] = k == 0 ? R_lp_(1, i) : k == 1 ? -R_lp_(0, i) : Pack(0.0);
    }
  }
  still.around = nullptr;
  at_psi.around = nullptr;
  if (!needs_.any()) return;
  const Moment now = moment_at(timeline, interval, node.t);
  Mat3T<Dual<3, Pack>> R_at_psi;
  for (int i = 0; i < 3; ++i)
    for (int row = 0; row < 3; ++row) {
      R_at_psi(row, i).v = R_lp_(row, i);
      for (int k = 0; k < 3; ++k) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        R_at_psi(row, i).d[k] = row == a ? -R_lp_(b, i) : row == b ? R_lp_(a, i) : Pack(0.0);
      }
    }
  fill_surroundings<Pack>(needs_, now, R_lp_, nullptr, around_still_);
  fill_surroundings<Dual<3, Pack>>(needs_, now, R_at_psi, nullptr, around_at_psi_);
  still.around = &around_still_;
  at_psi.around = &around_at_psi_;
}

[[gnu::flatten]] void LaneLinearizer::evaluate(const Timeline& timeline, const Node& node,
                                               const Interval& interval, const Mat3& E_loop,
                                               const PackVec& phi, LaneJacobian& out) {
  look(timeline, node, interval, phi);
  const auto slots = rates_.slots_of(seen_);
  rates_.differentiate(seen_, derivative_.data());
  const PackMat R_ip = times(in_all_lanes(node.R_il), R_lp_),
                R_li = in_all_lanes(node.R_il.transpose());
  const RateChain<Pack> chain(model_, slots, seen_.at_psi.omega_ic_p, interval.omega_cmd_p, E_loop,
                              R_ip);
  out.A = times(times(R_ip, chain.by_attitude()), R_li);
  const auto& of_rates = rates_.entries();
  for (std::size_t e = 0; e < of_rates.size();) {
    const std::size_t state = of_rates[e].state;
    const Pack sigma(layout_.sigma[static_cast<Eigen::Index>(state)]);
    PackVec column = chain.by_slot(of_rates[e].slot, derivative_[e] * sigma);
    for (++e; e < of_rates.size() && of_rates[e].state == state; ++e)
      column += chain.by_slot(of_rates[e].slot, derivative_[e] * sigma);
    for (std::size_t i = 0; i < 3; ++i) out.B[3 * state + i] = column[static_cast<int>(i)];
  }
  if (!readout_.accelerometers) return;
  const auto read = accelerometers_.slots_of(seen_);
  PackMat H_l;
  for (int i = 0; i < 3; ++i) {
    const auto& f = seen_.at_psi.f_p[i];
    const auto& s = read[static_cast<std::size_t>(i)];
    out.acc[i] = f.v + s.v;
    for (int k = 0; k < 3; ++k) H_l(i, k) = f.d[k] + s.d[k];
  }
  out.H = times(H_l, R_li);
  accelerometers_.differentiate(seen_, derivative_.data());
  for (std::size_t e = 0; e < readout().size(); ++e)
    out.H_par[e] =
        derivative_[e] *
        Pack(layout_.sigma[static_cast<Eigen::Index>(layout_.num_rate + readout()[e].state)]);
}

LaneLinearizer::Gimbals LaneLinearizer::gimbals(const Node& node, double heading,
                                                const PackVec& phi) const {
  const Mat3 R_cl = case_attitude(heading).transpose();
  const PackMat R_cp = times(in_all_lanes(R_cl * node.R_lr), rotation(phi));
  return {gimbal_angles(R_cp),
          times(gimbal_angles_by_rotation(R_cp), in_all_lanes(R_cl * node.R_il.transpose()))};
}

/// chi' (attitude_rate_l, kinematics.hpp).
[[gnu::flatten]] PackVec LaneLinearizer::rate(double t, const Mat3& R_lr, const PackVec& chi) {
  const PackVec phi = times_vector(in_all_lanes(R_lr.transpose()), chi);
  const PackMat R_rp = rotation(phi), R_lp = times(in_all_lanes(R_lr), R_rp);
  Inputs<Pack>& in = seen_.still;
  for (int i = 0; i < 3; ++i) {
    in.f_p[i] = R_lp(2, i);
    in.omega_ic_p[i] =
        mul_add(R_lp(0, i), omega_ic_l_[0],
                mul_add(R_lp(1, i), omega_ic_l_[1], R_lp(2, i) * Pack(omega_ic_l_[2])));
  }
  in.around = nullptr;
  if (needs_.any()) {
    fill_surroundings<Pack>(needs_, moment_at(*timeline_, *interval_, t), R_lp, nullptr,
                            around_still_);
    in.around = &around_still_;
  }
  RateAssembly<Pack> sum;
  for (int i = 0; i < 3; ++i) sum.omega_torque_g[i] = Pack(-in.omega_cmd_p[i]);
  rates_.add_plain_to(seen_, sum);
  const PackVec omega_ip_p = rate_of_slots(model_.coupling, sum, in.omega_ic_p, E_loop_);
  const PackVec phi_rate = rotation_vector_rate(phi, R_rp, omega_ip_p, in.omega_cmd_p);
  return times_vector(in_all_lanes(R_lr), phi_rate + cross(in.omega_cmd_p, phi)) -
         cross(omega_ie_l_, chi);
}

PackVec LaneLinearizer::step(double t, double length, const Mat3& from, const Mat3& half,
                             const Mat3& to, const PackVec& phi) {
  const PackVec chi = times_vector(in_all_lanes(from), phi);
  const double middle = t + 0.5 * length;
  const PackVec k1 = rate(t, from, chi), k2 = rate(middle, half, plus(chi, 0.5 * length, k1)),
                k3 = rate(middle, half, plus(chi, 0.5 * length, k2)),
                k4 = rate(t + length, to, plus(chi, length, k3));
  return times_vector(in_all_lanes(to.transpose()),
                      plus(chi, length / 6.0, plus(PackVec(k1 + k4), 2.0, k2 + k3)));
}

void LaneLinearizer::drive(const Timeline& timeline, const Interval& interval) {
  timeline_ = &timeline;
  interval_ = &interval;
  seen_.still.omega_cmd_p = interval.omega_cmd_p;
  omega_ic_l_ = timeline.nodes[interval.first_node].omega_ic_l;
  omega_ie_l_ = timeline.site.omega_ie_l();
  E_loop_ = misalignment_matrix(model_.mounting, interval.loop);
}

void LaneLinearizer::forward(const Timeline& timeline, const Interval& interval, PackVec* phi,
                             std::size_t from) {
  drive(timeline, interval);
  const double length = interval.length() / (2.0 * interval.substeps);
  const Node* node = &timeline.nodes[interval.first_node];
  for (std::size_t k = from; k + 1 < interval.node_count(); ++k)
    phi[k + 1] = step(node[k].t, length, node[k].R_lr, node[k].R_lr_half, node[k + 1].R_lr, phi[k]);
}

void LaneLinearizer::backward(const Timeline& timeline, const Interval& interval, PackVec* phi) {
  drive(timeline, interval);
  const double length = interval.length() / (2.0 * interval.substeps);
  const Node* node = &timeline.nodes[interval.first_node];
  for (std::size_t k = interval.node_count() - 1; k-- > 0;)
    phi[k] =
        step(node[k + 1].t, -length, node[k + 1].R_lr, node[k].R_lr_half, node[k].R_lr, phi[k + 1]);
}

}  // namespace drift
