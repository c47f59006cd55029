#include "core/estimate/linearize.hpp"

#include <Eigen/LU>

namespace drift {
namespace {

/// A matrix of three columns, each filled up to a whole register.
class Columns {
 public:
  explicit Columns(const Mat3& M) {
    for (int j = 0; j < 3; ++j) column_[j] << M.col(j), 0.0;
  }
  Eigen::Vector4d times(const double* v) const {
    return column_[0] * v[0] + column_[1] * v[1] + column_[2] * v[2];
  }

 private:
  Eigen::Vector4d column_[3];
};

/// out = Phi G + C0 B0 + C1 B1 + C2 B2, column by column.
void accumulate(const Mat3& Phi, const Mat3X& G, const Mat3& C0, const Mat3X& B0, const Mat3& C1,
                const Mat3X& B1, const Mat3& C2, const Mat3X& B2, Mat3X& out) {
  const Columns by_G(Phi), by_0(C0), by_1(C1), by_2(C2);
  const double *g = G.data(), *b0 = B0.data(), *b1 = B1.data(), *b2 = B2.data();
  double* into = out.data();
  for (Eigen::Index c = 0; c < out.cols(); ++c, g += 3, b0 += 3, b1 += 3, b2 += 3, into += 3) {
    const Eigen::Vector4d sum = by_G.times(g) + by_0.times(b0) + by_1.times(b1) + by_2.times(b2);
    for (int i = 0; i < 3; ++i) into[i] = sum[i];
  }
}

/// out += A G.
void add_product(const Mat3& A, const Mat3X& G, Mat3X& out) {
  const Columns by(A);
  const double* g = G.data();
  double* into = out.data();
  for (Eigen::Index c = 0; c < out.cols(); ++c, g += 3, into += 3) {
    const Eigen::Vector4d product = by.times(g);
    for (int i = 0; i < 3; ++i) into[i] += product[i];
  }
}

}  // namespace

void mean_output(const Interval& interval, const IntervalSensitivity& sensitivity,
                 MeanOutput& mean) {
  const auto middle = static_cast<std::size_t>(interval.substeps);
  const Mat3 Phi_m_inv = sensitivity.Phi[middle].inverse();
  mean.acc.setZero();
  mean.H.setZero();
  mean.H_rate.setZero(3, sensitivity.G[0].cols());
  mean.H_par.setZero(3, sensitivity.jacobian[0].H_par.cols());
  for (std::size_t k = 0; k < interval.node_count(); ++k) {
    const double w = Timeline::simpson_weight(interval.substeps, k);
    const NodeJacobian& j = sensitivity.jacobian[k];
    mean.acc += w * j.acc;
    mean.H += w * j.H * sensitivity.Phi[k] * Phi_m_inv;
    if (k > 0) add_product(w * j.H, sensitivity.G[k], mean.H_rate);  // G[0] is zero
    mean.H_par += w * j.H_par;
  }
  add_product(-mean.H, sensitivity.G[middle], mean.H_rate);
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
    accumulate(Phi1, out.G[k], h * 5.0 / 12.0 * Phi1, j0.B, h * 8.0 / 12.0 * I, j1.B,
               -h / 12.0 * from_end, j2.B, out.G[k + 1]);
    accumulate(Phi2, out.G[k], h / 3.0 * Phi2, j0.B, h * 4.0 / 3.0 * from_middle, j1.B, h / 3.0 * I,
               j2.B, out.G[k + 2]);
  }
}

}  // namespace drift
