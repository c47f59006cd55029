// Sensitivities of a test to its parameters, against differences and against CVODES.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/estimate/batch.hpp"
#include "tests/support/forward_sensitivity.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::sensitivity_test {
namespace {

using namespace drift::test;

TEST(Sensitivity, EquationsOfMotionAgreeWithDifferences) {
  // Rows of the whitened Jacobian against central differences of whole simulated tests. Steps of
  // 1e-3 prior sigma: truncation 1e-6 of the nonlinearity; the quadrature adds (0.05 rad)^4 in
  // slews.
  for (const auto& test : {std::pair{"eighteen", CommandLaw::free},
                           {"slew12", CommandLaw::level},
                           {"casespin", CommandLaw::level}})
    for (const Coupling coupling : {Coupling::eq5, Coupling::eq6, Coupling::lambda}) {
      ModelSpec spec = base_spec(coupling);
      if (coupling == Coupling::lambda) spec.active.set(param("lambda"));
      const DriftModel model = spec.model();
      const Layout layout = make_layout(spec);
      const Timeline timeline = preset_timeline(test.first, test.second, 600.0);
      Theta theta = random_theta(21);
      theta[param("lambda")] = 0.4;
      const Readout readout;
      const auto n = static_cast<Eigen::Index>(timeline.intervals.size());
      const Measurements zero{Mat3X::Zero(3, n), Mat3X::Zero(3, n)};
      const std::vector<Vec3> psi(timeline.chains, Vec3(1e-3, -5e-4, 2e-3));
      const auto predicted = [&](const Theta& t, const std::vector<Vec3>& psi0) {
        const auto chains =
            measurement_equations({timeline, readout, zero}, model, layout, t,
                                  integrate_fixed(timeline, model, t, psi0), spec.initial_attitude);
        return VecX(-chains.back().rows.rightCols<1>());
      };
      const MatX J =
          measurement_equations({timeline, readout, zero}, model, layout, theta,
                                integrate_fixed(timeline, model, theta, psi), spec.initial_attitude)
              .back()
              .rows;
      const double h = 1e-3;
      const auto compare = [&](const VecX& difference, const VecX& column,
                               const std::string& what) {
        // Gimbal angles jump by a turn near +-180 deg: leave those rows out.
        double worst = 0.0, scale = 0.0;
        for (Eigen::Index r = 0; r < column.size(); ++r) {
          if (std::abs(difference[r]) > 1e6) continue;
          worst = std::max(worst, std::abs(difference[r] - column[r]));
          scale = std::max(scale, std::abs(column[r]));
        }
        EXPECT_LT(worst, 2e-4 * scale + 1e-5) << what << " " << test.first;
      };
      for (std::size_t k = 0; k < layout.size(); ++k) {
        Theta up = theta, down = theta;
        up[layout.params[k]] += h * layout.sigma[k];
        down[layout.params[k]] -= h * layout.sigma[k];
        compare((predicted(up, psi) - predicted(down, psi)) / (2.0 * h),
                J.col(3 + static_cast<Eigen::Index>(k)),
                std::string(TermLibrary::specs[layout.params[k]].key.view()));
      }
      for (int a = 0; a < 3; ++a) {
        auto up = psi, down = psi;
        up.back()[a] += h * spec.initial_attitude;
        down.back()[a] -= h * spec.initial_attitude;
        // psi is composed to first order at 2.3e-3 rad: relative error 1e-3.
        const VecX difference = (predicted(theta, up) - predicted(theta, down)) / (2.0 * h);
        const VecX column = J.col(a);
        for (Eigen::Index r = 0; r < column.size(); ++r)
          if (std::abs(difference[r]) < 1e6) {
            EXPECT_NEAR(difference[r], column[r], 3e-3 * column.norm());
          }
      }
    }
}

TEST(Sensitivity, VariationOfConstantsAgreesWithCvodesForwardSensitivities) {
  // Attitude at the end of an hour of free drift, with respect to every rate parameter: CVODES'
  // staggered method on phi against the quadrature of linearize_interval on psi.
  TestPlan plan = preset_plan("six", PlanDefaults{}).value();
  plan.positions.resize(1);
  const Timeline timeline = lay_out(plan, harbin);
  const ModelSpec spec = base_spec(Coupling::eq5);
  const DriftModel model = spec.model();
  const Layout layout = make_layout(spec);
  const Theta theta = random_theta(5);
  const Vec3 omega_ie_l = harbin.omega_ie_l();
  using D = Dual<4>;  // phi, and one parameter at a time

  const auto rate = [&](double t, const double* phi, std::size_t parameter, double scale) {
    const Mat3 R_lr = rotation<double>(-omega_ie_l * t) * timeline.nodes[0].R_lr;
    std::array<D, TermLibrary::num_params> p;
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = D(theta[i]);
    p[parameter].d[3] = scale;
    Vec3T<D> v;
    for (int i = 0; i < 3; ++i) v[i] = D::variable(phi[i], i);
    const Mat3T<D> R_rp = rotation(v);
    const Inputs<D> in =
        inputs_at<D>(omega_ie_l, Vec3::Zero(), model.mounting, R_lr.cast<D>() * R_rp);
    return rotation_vector_rate<D>(v, R_rp, platform_rate(model, in, p.data(), Mat3::Zero()),
                                   Vec3::Zero());
  };
  const auto rhs = [&](double t, const double* y, double* f) {
    const Vec3T<D> r = rate(t, y, 0, 0.0);
    for (int i = 0; i < 3; ++i) f[i] = r[i].v;
    return true;
  };
  const auto sensitivity_rhs = [&](double t, const double* y, const double*, const double* S,
                                   double* S_dot) {
    for (std::size_t c = 0; c < layout.num_rate; ++c) {
      const Vec3T<D> r = rate(t, y, layout.params[c], layout.sigma[c]);
      for (int i = 0; i < 3; ++i) {
        S_dot[3 * c + i] = r[i].d[3];
        for (int k = 0; k < 3; ++k) S_dot[3 * c + i] += r[i].d[k] * S[3 * c + k];
      }
    }
    return true;
  };
  OdeOptions options;
  const auto nr = static_cast<Eigen::Index>(layout.num_rate);
  const std::vector<double> scale(layout.num_rate, 1.0);
  const double hour = timeline.intervals.back().t1;
  const SensitivityResult oracle = integrate_with_sensitivities(
      rhs, sensitivity_rhs, options, 0.0, VecX::Zero(3), MatX::Zero(3, nr), scale, hour);
  ASSERT_TRUE(oracle.result.ok()) << oracle.result.cause;

  const Trajectory phi = integrate_fixed(timeline, model, theta, {Vec3::Zero()});
  EXPECT_LT((phi.back() - oracle.y).norm(), 1e-11);
  Linearizer linearizer(model, layout, Readout{});
  linearizer.set_theta(theta);
  IntervalSensitivity inner;
  Rows3 G = padded_rows(layout.num_rate);
  for (const Interval& i : timeline.intervals) {
    linearize_interval(i, timeline, Mat3::Zero(), &phi[i.first_node], nullptr, linearizer, inner);
    G = (inner.Phi.back() * G + inner.G.back()).eval();
  }
  // psi (inertial axes) of a small change of phi: psi = R_ir J_l(phi) dphi, J_l the left Jacobian.
  const Node& end = timeline.nodes.back();
  const Vec3 v = phi.back();
  const double t = v.norm();
  const Mat3 k = skew<double>(v);
  const Mat3 J_l = Mat3::Identity() + (1.0 - std::cos(t)) / (t * t) * k +
                   (t - std::sin(t)) / (t * t * t) * k * k;
  const Mat3X expected = end.R_il * end.R_lr * J_l * oracle.S;
  for (Eigen::Index c = 0; c < nr; ++c)
    EXPECT_LT((G.col(c) - expected.col(c)).norm(), 1e-8 * expected.norm())
        << TermLibrary::specs[layout.params[c]].key.view();
}

}  // namespace
}  // namespace drift::sensitivity_test
