// Closed forms of the gimbal chain.
#include "core/physics/gimbals.hpp"

#include <gtest/gtest.h>

#include "core/physics/term_library.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::gimbals_test {
namespace {

using namespace drift::test;

TEST(GimbalNonorthogonality, IsTheChainWithTwoSmallRotationsInIt) {
  const double nu1 = 20.0 * arcsec, nu2 = -15.0 * arcsec;
  const Vec3 read(0.7, -0.5, 2.1);  // what the resolvers say
  const Mat3 R_cp = rotation(Vec3(read[0], 0, 0)) * rotation(Vec3(0, 0, nu1)) *
                    rotation(Vec3(0, read[1], 0)) * rotation(Vec3(nu2, 0, 0)) *
                    rotation(Vec3(0, 0, read[2]));
  Surroundings<double> around;
  around.gimbal = gimbal_angles<double>(R_cp);
  Inputs<double> in;
  in.around = &around;
  GimbalAssembly<double> out;
  const double p[2] = {nu1, nu2};
  terms::GimbalNonorthogonality::gimbals(in, p, out);
  EXPECT_LT((around.gimbal + out.error - read).norm(), 10.0 * nu1 * nu1);  // first order
}

TEST(Gimbals, AxesAndRatesBelongToTheChain) {
  const Vec3 angle(0.7, -0.5, 2.1), rate(1e-3, -2e-3, 1.5e-3);
  const Vec3 omega_cp_p = gimbal_axes(angle) * rate;
  EXPECT_LT((gimbal_rates(angle, omega_cp_p) - rate).norm(), 1e-17);
  const double h = 1e-3;
  const Mat3 before = gimbal_chain(angle - h * rate), after = gimbal_chain(angle + h * rate);
  EXPECT_LT((rotation_vector(before.transpose() * after) / (2.0 * h) - omega_cp_p).norm(), 1e-12);
}

}  // namespace
}  // namespace drift::gimbals_test
