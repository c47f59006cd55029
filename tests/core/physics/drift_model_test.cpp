#include "core/physics/drift_model.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/physics/parameters_config.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::drift_model_test {
namespace {

using namespace drift::test;

/// The terms of eqs. (5) and (6) and of the family between them: those that see no more than a
/// Scene.
TermMask equation_terms() {
  ParamMask params = base_parameters();
  params.set(param("lambda"));
  return TermLibrary::terms_of(params);
}

/// A platform at some attitude, in some motion, with random parameters.
struct Scene {
  Mounting mounting;
  Inputs<double> in;
  Theta theta;
  explicit Scene(std::uint64_t seed) : theta(random_theta(seed)) {
    Stream s(seed, 1, Purpose::test, 7);
    const auto random3 = [&] { return Vec3{s.normal(), s.normal(), s.normal()}; };
    in.mounting = &mounting;
    in.f_p = random3().normalized();
    in.omega_ic_p = 7.3e-5 * random3();
    in.omega_cmd_p = 1e-4 * random3();
  }
  Vec3 omega_cp(Coupling coupling, double lambda = 0.0) {
    DriftModel model{coupling, {}, mounting};
    model.terms = equation_terms();
    theta[param("lambda")] = lambda;
    return platform_rate(model, in, theta.data(), Mat3::Zero()) - in.omega_ic_p;
  }
  RateAssembly<double> parts() {
    DriftModel model{Coupling::eq5, {}, mounting};
    model.terms = equation_terms();
    return assemble(model, in, theta.data());
  }
};

TEST(DriftModel, Equation5IsCTimesEquation6) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Scene s(seed);
    const Mat3 C = Mat3::Identity() + s.parts().E_gp;
    const Vec3 w5 = s.omega_cp(Coupling::eq5), w6 = s.omega_cp(Coupling::eq6);
    EXPECT_LT((w5 - C * w6).norm(), 1e-14 * w5.norm()) << seed;  // a few roundings of 1e-16
  }
}

TEST(DriftModel, EquationsAsPrintedInThePaper) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Scene s(seed);
    const auto a = s.parts();
    const Mat3 C = Mat3::Identity() + a.E_gp;
    const Vec3 u = a.omega_drift_g + a.omega_torque_g;
    const Vec3 w5 = -C * s.in.omega_ic_p - u;
    const Vec3 w6 = -s.in.omega_ic_p - C.inverse() * u;
    EXPECT_LT((s.omega_cp(Coupling::eq5) - w5).norm(), 1e-14 * w5.norm());
    EXPECT_LT((s.omega_cp(Coupling::eq6) - w6).norm(), 1e-14 * w6.norm());
  }
}

TEST(DriftModel, LambdaZeroAndOneAreTheTwoEquations) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Scene s(seed);
    const Vec3 w5 = s.omega_cp(Coupling::eq5), w6 = s.omega_cp(Coupling::eq6);
    EXPECT_LT((s.omega_cp(Coupling::lambda, 0.0) - w5).norm(), 1e-14 * w5.norm());
    EXPECT_LT((s.omega_cp(Coupling::lambda, 1.0) - w6).norm(), 1e-14 * w6.norm());
  }
}

TEST(DriftModel, LambdaFamilySolvesItsDefinition) {
  Scene s(3);
  const auto a = s.parts();
  for (const double lambda : {-0.5, 0.3, 0.7, 2.0}) {
    const Vec3 w = s.omega_cp(Coupling::lambda, lambda);
    const Vec3 rest = (Mat3::Identity() + lambda * a.E_gp) * w +
                      (Mat3::Identity() + a.E_gp) * s.in.omega_ic_p + a.omega_drift_g +
                      a.omega_torque_g;
    EXPECT_LT(rest.norm(), 1e-14 * w.norm());
  }
}

TEST(DriftModel, ACompensatedLoopWithPerfectKnowledgeIsFreeOfCaseMotion) {
  // w_cp = -C-hat^-1 (C w_ic + u) with C-hat = C is eq. (6); with C-hat = I it is eq. (5).
  Scene s(5);
  DriftModel model{Coupling::compensated, {}, s.mounting};
  model.terms = equation_terms();
  const Mat3 E = s.parts().E_gp;
  const auto rate = [&](const Mat3& E_loop) -> Vec3 {
    return platform_rate(model, s.in, s.theta.data(), E_loop) - s.in.omega_ic_p;
  };
  EXPECT_LT((rate(E) - s.omega_cp(Coupling::eq6)).norm(), 1e-18);
  EXPECT_LT((rate(Mat3::Zero()) - s.omega_cp(Coupling::eq5)).norm(), 1e-18);
}

TEST(DriftModel, EquationsAgreeToFirstOrderWhenTheCommandCancelsEarthRate) {
  const auto gap = [](double eta) {
    Scene s(9);
    s.theta.setZero();
    s.theta[param("eta_x")] = eta;
    s.theta[param("xi_y")] = -eta;
    s.theta[param("eta_z")] = 0.5 * eta;
    s.in.omega_cmd_p = s.in.omega_ic_p;
    return (s.omega_cp(Coupling::eq5) - s.omega_cp(Coupling::eq6)).norm();
  };
  EXPECT_NEAR(gap(1e-3) / gap(1e-4), 100.0, 1.0);  // second order: 10x smaller, 100x smaller gap
}

TEST(DriftModel, WithoutCommandAndDriftOnlyEquation5SeesMisalignment) {
  Scene s(11);
  s.theta.setZero();
  s.in.omega_cmd_p.setZero();
  s.theta[param("eta_x")] = 100.0 * arcsec;
  EXPECT_EQ((s.omega_cp(Coupling::eq6) + s.in.omega_ic_p).norm(), 0.0);
  const double expected = 100.0 * arcsec * std::abs(s.in.omega_ic_p.z());  // eta_x: x gyro toward z
  // omega_cp is rounded to eps of Earth rate before it is taken off again.
  const double bound = 4.0 * std::numeric_limits<double>::epsilon() * s.in.omega_ic_p.norm();
  EXPECT_NEAR((s.omega_cp(Coupling::eq5) + s.in.omega_ic_p).norm(), expected, bound);
}

TEST(DriftModel, TriadsPlaceTheAnglesAsInTheNotation) {
  // E = [[0, xi_x, eta_x], [eta_y, 0, xi_y], [xi_z, eta_z, 0]] (physics.md 1.1).
  MisalignmentAngles angles;
  angles << 1, 2, 3, 4, 5, 6;
  Mat3 expected;
  expected << 0, 4, 1, 2, 0, 5, 6, 3, 0;
  EXPECT_EQ(misalignment_matrix(Mounting{}, angles), expected);
}

TEST(Accelerometer, FollowsTheModelEquation) {
  Scene s(2);
  DriftModel model{Coupling::eq5, {}, s.mounting};
  model.terms = equation_terms();
  const Vec3 out = accelerometer_output(model, s.in, s.theta.data());
  for (int i = 0; i < 3; ++i) {
    const double a_i = s.in.f_p[i], a_p = s.in.f_p[(i + 1) % 3], a_o = s.in.f_p[(i + 2) % 3];
    const auto p = [&](const char* group) {
      return s.theta[param(std::string(group) + "_" + "xyz"[i])];
    };
    const double expected = p("K0") + (1.0 + p("K1")) * (a_i + p("dP") * a_p + p("dO") * a_o) +
                            p("K2") * a_i * a_i + p("K3") * a_i * a_i * a_i + p("K_ip") * a_i * a_p;
    EXPECT_NEAR(out[i], expected, 1e-15);
  }
}

}  // namespace
}  // namespace drift::drift_model_test
