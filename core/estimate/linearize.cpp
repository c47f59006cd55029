#include "core/estimate/linearize.hpp"

#include <Eigen/LU>

#include "core/base/check.hpp"

namespace drift {

Linearizer::Linearizer(const DriftModel& model, const Layout& layout, Readout readout)
    : model_(model), layout_(layout), readout_(readout), needs_(TermLibrary::needs(model.terms)) {
  set_theta(layout_.theta);
  remembered_.resize(layout_.size());
  for (std::size_t k = 0; k < layout_.size(); ++k)
    TermLibrary::for_each_memory(model_.terms, [&]<class T>(const TermInfo& info) {
      if (layout_.params[k] == info.first + T::memory_parameter)
        remembered_[k] = {info.first_memory, info.memory};
    });
}

void Linearizer::set_theta(const Theta& theta) {
  for (std::size_t i = 0; i < theta_.size(); ++i) theta_[i].v = theta[i];
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

/// Makes state number `state` the variable k of a chunk, or (derivative 0) no variable again.
void Linearizer::seed(std::size_t state, std::size_t k, double derivative) {
  theta_[layout_.params[state]].d[k] = derivative;
  const Remembered& r = remembered_[state];
  for (int m = r.first; m < r.first + r.count; ++m) {
    const auto at = static_cast<std::size_t>(m);
    memory_[at].d[k] = derivative * memory_derivative_[at];
  }
}

/// Runs over the variables (psi_l x, y, z, then `count` states from first_state) in chunks. Calls
/// sink(in, first, n): the inputs as duals and which variables the n derivatives are.
template <class Sink>
void Linearizer::sweep(std::size_t first_state, std::size_t count, Sink&& sink) {
  const std::size_t variables = 3 + count;
  for (std::size_t first = 0; first < variables; first += chunk) {
    const std::size_t n = std::min<std::size_t>(chunk, variables - first);
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t v = first + k;
      if (v < 3) continue;
      const std::size_t state = first_state + v - 3;
      seed(state, k, layout_.sigma[state]);
    }
    sink(first < 3 ? seen_.at_psi : seen_.still, first, n);
    for (std::size_t k = 0; k < n; ++k)
      if (first + k >= 3) seed(first_state + first + k - 3, k, 0.0);
  }
}

/// Works out what the terms see at an attitude. What the base terms see is linear in R_lp, so its
/// derivative is what they would see of dR_lp.
void Linearizer::look(const Node& node, const Interval& interval, const Mat3& R_lp,
                      const Timeline* timeline, const MemoryPoint* memory) {
  const auto seen = [&](const Mat3& R) {
    return inputs_at<double>(node.omega_ic_l, interval.omega_cmd_p, model_.mounting, R);
  };
  const Inputs<double> value = seen(R_lp);
  Inputs<D>&still = seen_.still, &at_psi = seen_.at_psi;
  still.mounting = value.mounting;
  still.f_p = value.f_p.cast<D>();
  still.omega_ic_p = value.omega_ic_p.cast<D>();
  still.omega_cmd_p = value.omega_cmd_p;
  at_psi = still;
  std::array<Mat3, 3> dR_lp;
  for (int k = 0; k < 3; ++k) {  // exp([psi x]) R at psi = 0, to first order
    dR_lp[k] = skew<double>(Vec3::Unit(k)) * R_lp;
    const Inputs<double> d = seen(dR_lp[k]);
    for (int i = 0; i < 3; ++i) {
      at_psi.f_p[i].d[k] = d.f_p[i];
      at_psi.omega_ic_p[i].d[k] = d.omega_ic_p[i];
    }
  }
  if (!needs_.any()) return;
  DRIFT_DEMAND(timeline != nullptr && (memory != nullptr || !needs_.memory));
  const Moment now = moment_at(*timeline, interval, node.t);
  if (needs_.memory)
    for (std::size_t k = 0; k < num_memory; ++k) {
      memory_[k] = D(memory->value[k]);
      memory_derivative_[k] = memory->derivative[k];
    }
  Mat3T<D> R = R_lp.cast<D>();
  fill_surroundings(needs_, now, R, memory_.data(), seen_.still_around);
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 9; ++i) R.data()[i].d[k] = dR_lp[k].data()[i];
  fill_surroundings(needs_, now, R, memory_.data(), seen_.around_at_psi);
  still.around = &seen_.still_around;
  at_psi.around = &seen_.around_at_psi;
}

void Linearizer::evaluate(const Node& node, const Interval& interval, const Mat3& E_loop,
                          const Vec3& phi, const Timeline* timeline, const MemoryPoint* memory,
                          NodeJacobian& out) {
  const Mat3 R_lp = node.R_lr * rotation(phi);
  const Mat3 R_ip = node.R_il * R_lp;
  look(node, interval, R_lp, timeline, memory);
  Mat3 A_l;
  sweep(0, layout_.num_rate, [&](const Inputs<D>& in, std::size_t first, std::size_t n) {
    const Vec3T<D> omega_ip_p = platform_rate(model_, in, theta_.data(), E_loop);
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3 d(omega_ip_p[0].d[k], omega_ip_p[1].d[k], omega_ip_p[2].d[k]);
      if (first + k < 3)
        A_l.col(first + k) = d;
      else
        out.B.col(first + k - 3).noalias() = R_ip * d;
    }
  });
  out.A = R_ip * A_l * node.R_il.transpose();
  if (!readout_.accelerometers) return;
  Mat3 H_l;
  sweep(layout_.num_rate, layout_.size() - layout_.num_rate,
        [&](const Inputs<D>& in, std::size_t first, std::size_t n) {
          const Vec3T<D> acc = accelerometer_output(model_, in, theta_.data());
          out.acc = Vec3(acc[0].v, acc[1].v, acc[2].v);
          for (std::size_t k = 0; k < n; ++k) {
            const Vec3 d(acc[0].d[k], acc[1].d[k], acc[2].d[k]);
            if (first + k < 3)
              H_l.col(first + k) = d;
            else
              out.H_par.col(first + k - 3) = d;
          }
        });
  out.H = H_l * node.R_il.transpose();
}

GimbalPrediction Linearizer::gimbals(const Timeline& timeline, const Interval& interval,
                                     const Vec3& phi, const MemoryPoint* memory) {
  const Node& node = timeline.nodes[interval.last_node()];
  if (!TermLibrary::act_on_gimbals(model_.terms))
    return predict_gimbals(node, interval.heading1, phi);
  const Mat3 R_lp = node.R_lr * rotation(phi);
  look(node, interval, R_lp, &timeline, memory);
  Mat3T<D> R_at_psi = R_lp.cast<D>();
  for (int k = 0; k < 3; ++k) {
    const Mat3 d = skew<double>(Vec3::Unit(k)) * R_lp;
    for (int i = 0; i < 9; ++i) R_at_psi.data()[i].d[k] = d.data()[i];
  }
  const Mat3T<D> R_still = R_lp.cast<D>();
  GimbalPrediction out;
  out.H_par = Mat3X::Zero(3, layout_.size() - layout_.num_rate);
  Mat3 H_l;
  sweep(layout_.num_rate, layout_.size() - layout_.num_rate,
        [&](const Inputs<D>& in, std::size_t first, std::size_t n) {
          const Vec3T<D> angles = gimbal_output<D>(model_, in, first < 3 ? R_at_psi : R_still,
                                                   interval.heading1, theta_.data());
          for (int a = 0; a < 3; ++a) {
            out.angles[a] = angles[a].v;
            for (std::size_t k = 0; k < n; ++k) {
              if (first + k < 3)
                H_l(a, first + k) = angles[a].d[k];
              else
                out.H_par(a, first + k - 3) = angles[a].d[k];
            }
          }
        });
  out.H = H_l * node.R_il.transpose();
  return out;
}

MeanOutput mean_output(const Interval& interval, IntervalSensitivity& sensitivity) {
  MeanOutput mean;
  const Mat3 Phi_m_inv = sensitivity.Phi[static_cast<std::size_t>(interval.substeps)].inverse();
  Mat3X& H_par = sensitivity.jacobian[0].H_par;
  for (std::size_t k = 0; k < interval.node_count(); ++k) {
    const double w = Timeline::simpson_weight(interval.substeps, k);
    const NodeJacobian& j = sensitivity.jacobian[k];
    mean.acc += w * j.acc;
    mean.H += w * j.H * sensitivity.Phi[k] * Phi_m_inv;
    if (k == 0)
      H_par *= w;
    else
      H_par += w * j.H_par;
  }
  return mean;
}

void linearize_interval(const Interval& interval, const Timeline& timeline, const Mat3& E_loop,
                        const Vec3* phi, const MemoryPoint* memory, Linearizer& linearizer,
                        IntervalSensitivity& out) {
  const std::size_t nodes = interval.node_count();
  while (out.jacobian.size() < nodes) {
    out.jacobian.push_back(linearizer.make());
    out.Phi.emplace_back();
    out.G.push_back(out.jacobian.back().B);
  }
  for (std::size_t k = 0; k < nodes; ++k)
    linearizer.evaluate(timeline.nodes[interval.first_node + k], interval, E_loop, phi[k],
                        &timeline, memory ? &memory[2 * k] : nullptr, out.jacobian[k]);
  const double h = interval.length() / (2.0 * interval.substeps);
  const Mat3 I = Mat3::Identity();
  const auto exponential = [&](const Mat3& a) -> Mat3 { return I + a + 0.5 * a * a; };
  out.Phi[0] = I;
  out.G[0].setZero();
  for (std::size_t k = 0; k + 2 < nodes; k += 2) {
    const NodeJacobian &j0 = out.jacobian[k], &j1 = out.jacobian[k + 1], &j2 = out.jacobian[k + 2];
    // Integrals of the parabola through the three nodes, to the middle and to the end.
    const Mat3 a1 = h / 12.0 * (5.0 * j0.A + 8.0 * j1.A - j2.A);
    const Mat3 a2 = h / 3.0 * (j0.A + 4.0 * j1.A + j2.A);
    const Mat3 Phi1 = exponential(a1), Phi2 = exponential(a2);
    const Mat3 from_end = exponential(a1 - a2), from_middle = exponential(a2 - a1);
    out.Phi[k + 1] = Phi1 * out.Phi[k];
    out.Phi[k + 2] = Phi2 * out.Phi[k];
    out.G[k + 1].noalias() = Phi1 * out.G[k];
    out.G[k + 1].noalias() += (h * 5.0 / 12.0 * Phi1) * j0.B;
    out.G[k + 1].noalias() += h * 8.0 / 12.0 * j1.B;
    out.G[k + 1].noalias() -= (h / 12.0 * from_end) * j2.B;
    out.G[k + 2].noalias() = Phi2 * out.G[k];
    out.G[k + 2].noalias() += (h / 3.0 * Phi2) * j0.B;
    out.G[k + 2].noalias() += (h * 4.0 / 3.0 * from_middle) * j1.B;
    out.G[k + 2].noalias() += h / 3.0 * j2.B;
  }
}

}  // namespace drift
