#include "analysis/observability/pwcs.hpp"

#include <algorithm>
#include <limits>

#include "core/base/decompose.hpp"
#include "core/estimate/gimbal_prediction.hpp"
#include "core/estimate/linearize.hpp"
#include "core/estimate/triangle.hpp"
#include "core/plan/case_heading.hpp"

namespace drift::observability {
namespace {

struct Spectrum {
  VecX values;
  MatX V;
  int rank = 0;
};

/// SVD of a tall or wide matrix, all right vectors. The triangle of a QR stands for the matrix.
Spectrum spectrum(const MatX& matrix) {
  const Eigen::Index n = matrix.cols();
  MatX square = MatX::Zero(n, n);
  if (matrix.rows() > n)
    square = triangle(matrix);
  else
    square.topRows(matrix.rows()) = matrix;
  const RightSingular svd = right_singular(square);
  Spectrum out{svd.values, svd.vectors, 0};
  while (out.rank < n && out.values[out.rank] > pwcs_tolerance * out.values[0]) ++out.rank;
  return out;
}

/// The platform at its nominal attitude, following the Earth, at the instant of caging: the chain's
/// inertial frame is the local frame there.
Node level_node(const Site& site, const Mat3& R_lp) {
  Node node;
  node.R_lr = node.R_lr_half = R_lp;
  node.R_il = Mat3::Identity();
  node.omega_ic_l = site.omega_ie_l();
  return node;
}

}  // namespace

std::vector<PwcsPosition> pwcs_positions(const TestPlan& plan, const Site& site,
                                         const ModelSpec& spec, const Readout& channels) {
  TestPlan level = plan;
  for (Position& p : level.positions) {
    p.entry = Entry::caged;
    p.mode = CommandLaw::level;
  }
  const std::vector<Passage> passages = plan_passages(level, site);
  const Layout layout = make_layout(spec);
  // Terms that ask for time, memory or surroundings have no part in a problem that is constant.
  DriftModel model = spec.model();
  for (std::size_t t = 0; t < TermLibrary::terms.size(); ++t)
    if (TermLibrary::terms[t].needs.any()) model.terms.reset(t);
  Linearizer linearizer(model, layout, channels);
  linearizer.set_theta(Theta::Zero());
  NodeJacobian j = linearizer.make();

  const auto nr = static_cast<Eigen::Index>(layout.num_rate);
  const auto n = static_cast<Eigen::Index>(3 + layout.size());
  const Eigen::Index outputs = (channels.accelerometers ? 3 : 0) + (channels.gimbals ? 3 : 0);
  std::vector<PwcsPosition> out;
  for (std::size_t p = 0; p < passages.size(); ++p) {
    const Node node = level_node(site, level.positions[p].R_lp);
    Interval interval;
    interval.t1 = pwcs_time_unit;
    interval.omega_cmd_p = passages[p].dwell.omega_cmd_p;
    linearizer.evaluate({{{&node, &interval}}}, Mat3::Zero(), nullptr, &j);

    MatX F = MatX::Zero(n, n), H = MatX::Zero(outputs, n);
    F.topLeftCorner<3, 3>() = pwcs_time_unit * (j.A - skew(site.omega_ie_l()));
    F.block(0, 3, 3, nr) = pwcs_time_unit / spec.initial_attitude * j.B.leftCols(nr);
    if (channels.accelerometers) {
      H.topLeftCorner<3, 3>() = spec.initial_attitude * j.H;
      H.topRightCorner(3, n - 3 - nr) = j.H_par.leftCols(n - 3 - nr);
    }
    if (channels.gimbals)
      H.bottomLeftCorner<3, 3>() =
          spec.initial_attitude * predict_gimbals(node, passages[p].dwell.heading0, Vec3::Zero()).H;
    MatX Q(4 * outputs, n);
    Q.topRows(outputs) = H;
    for (Eigen::Index k = 1; k < 4; ++k)
      Q.middleRows(k * outputs, outputs) = Q.middleRows((k - 1) * outputs, outputs) * F;
    out.push_back({std::move(F), std::move(Q)});
  }
  return out;
}

PwcsRank pwcs_rank(const TestPlan& plan, const Site& site, const ModelSpec& spec,
                   const Readout& channels) {
  const std::vector<PwcsPosition> positions = pwcs_positions(plan, site, spec, channels);
  const Eigen::Index rows = positions.front().Q.rows(), n = positions.front().Q.cols();
  MatX stripped(rows * static_cast<Eigen::Index>(positions.size()), n);
  PwcsRank out;
  for (std::size_t p = 0; p < positions.size(); ++p) {
    const PwcsPosition& position = positions[p];
    stripped.middleRows(rows * static_cast<Eigen::Index>(p), rows) = position.Q;
    const Spectrum one = spectrum(position.Q);
    const MatX leak = position.F * one.V.rightCols(n - one.rank);
    out.leak = std::max(out.leak, leak.norm() / position.F.norm());
  }
  const Spectrum all = spectrum(stripped);
  out.rank = all.rank;
  out.states = static_cast<int>(n);
  out.singular_values = all.values;
  out.V = all.V;
  out.null_space = all.V.rightCols(n - all.rank);
  const double beyond = all.rank < n ? all.values[all.rank] : 0.0;
  out.gap =
      beyond > 0.0 ? all.values[all.rank - 1] / beyond : std::numeric_limits<double>::infinity();
  return out;
}

}  // namespace drift::observability
