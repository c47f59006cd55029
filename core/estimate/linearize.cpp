#include "core/estimate/linearize.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "core/estimate/transition.hpp"

namespace drift {

std::size_t most_nodes(const Timeline& timeline) {
  std::size_t most = 0;
  for (const Interval& i : timeline.intervals) most = std::max(most, i.node_count());
  return most;
}
void mean_output(const Interval& interval, const IntervalSensitivity& sensitivity,
                 MeanOutput& mean) {
  const auto middle = static_cast<std::size_t>(interval.substeps);
  const Mat3 Phi_m_inv = sensitivity.Phi[middle].inverse();
  mean.acc.setZero();
  mean.H.setZero();
  mean.H_rate.setZero(3, sensitivity.G[0].cols());
  mean.H_par.setZero(3, sensitivity.jacobian->H_par.cols());
  for (std::size_t k = 0; k < interval.node_count(); ++k) {
    const double w = Timeline::mean_weight(interval.substeps, k);
    const NodeJacobian& j = sensitivity.jacobian[k];
    mean.acc += w * j.acc;
    mean.H += w * j.H * sensitivity.Phi[k] * Phi_m_inv;
    if (k > 0)  // G[0] is zero
      sum_of_products<Sum::onto>({w * j.H}, {&sensitivity.G[k]}, mean.H_rate);
    mean.H_par += w * j.H_par;
  }
  sum_of_products<Sum::onto>({-mean.H}, {&sensitivity.G[middle]}, mean.H_rate);
}

void IntervalSensitivity::begin(const NodeJacobian* along, std::size_t nodes) {
  jacobian = along;
  while (Phi.size() < nodes) {
    Phi.emplace_back();
    G.push_back(along->B);
  }
}

void linearize_interval(const Interval& interval, const Timeline& timeline, const Mat3& E_loop,
                        const Vec3* phi, const MemoryPoint* memory, Linearizer& linearizer,
                        IntervalSensitivity& out) {
  const std::size_t nodes = interval.node_count();
  while (out.own.size() < nodes) out.own.push_back(linearizer.make());
  for (std::size_t first = 0; first < nodes; first += Linearizer::at_once) {
    const std::size_t count = std::min(nodes - first, Linearizer::at_once);
    std::array<NodePoint, Linearizer::at_once> points;
    for (std::size_t l = 0; l < count; ++l) {
      const std::size_t k = first + l;
      points[l] = {&timeline.nodes[interval.first_node + k], &interval, phi[k],
                   memory ? &memory[2 * k] : nullptr};
    }
    linearizer.evaluate({points.data(), count}, E_loop, &timeline, &out.own[first]);
  }
  propagate_sensitivity(interval, timeline, out.own.data(), out);
}

void propagate_sensitivity(const Interval& interval, const Timeline& timeline,
                           const NodeJacobian* jacobian, IntervalSensitivity& out) {
  const std::size_t nodes = interval.node_count();
  out.begin(jacobian, nodes);
  if (interval.rest) {
    for (std::size_t k = 0; k < nodes; ++k) {
      out.Phi[k] = timeline.nodes[interval.first_node + k].R_il *
                   timeline.nodes[interval.first_node].R_il.transpose();
      out.G[k].setZero();
    }
    return;
  }
  const double h = interval.length() / (2.0 * interval.substeps);
  const Mat3 I = Mat3::Identity();
  out.Phi[0] = I;
  out.G[0].setZero();
  for (std::size_t k = 0; k + 2 < nodes; k += 2) {
    const NodeJacobian &j0 = jacobian[k], &j1 = jacobian[k + 1], &j2 = jacobian[k + 2];
    const TwoSteps steps(j0.A, j1.A, j2.A, h);
    const Mat3 &Phi1 = steps.to_middle, &Phi2 = steps.to_end;
    const Mat3 from_end = small_exponential<double>(-steps.log_of_second),
               from_middle = small_exponential<double>(steps.log_of_second);
    out.Phi[k + 1] = Phi1 * out.Phi[k];
    out.Phi[k + 2] = Phi2 * out.Phi[k];
    sum_of_products<Sum::afresh>({h * 5.0 / 12.0 * Phi1, h * 8.0 / 12.0 * I, -h / 12.0 * from_end},
                                 {&j0.B, &j1.B, &j2.B}, out.G[k + 1]);
    sum_of_products<Sum::afresh>({h / 3.0 * Phi2, h * 4.0 / 3.0 * from_middle, h / 3.0 * I},
                                 {&j0.B, &j1.B, &j2.B}, out.G[k + 2]);
    if (k == 0) continue;  // G is zero there
    sum_of_products<Sum::onto>({Phi1}, {&out.G[k]}, out.G[k + 1]);
    sum_of_products<Sum::onto>({Phi2}, {&out.G[k]}, out.G[k + 2]);
  }
}

}  // namespace drift
