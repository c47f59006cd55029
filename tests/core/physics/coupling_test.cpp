#include "core/physics/coupling.hpp"

#include <gtest/gtest.h>

#include "core/physics/closure.hpp"
#include "core/physics/drift_model.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::coupling_test {
namespace {

using namespace drift::test;

TEST(Coupling, TheOtherOfTheOtherIsItself) {
  for (const CouplingFacts& c : couplings)
    if (c.other) {
      EXPECT_EQ(facts(*c.other).other, c.value) << c.name;
      EXPECT_NE(facts(*c.other).lambda, c.lambda) << c.name;
    }
}

TEST(Coupling, LambdaMakesOfTheFamilyTheEquationItStandsFor) {
  // The member of the family at an equation's own lambda gives that equation's rates: the same
  // expression but for the product lambda E.
  Theta theta = random_theta(3);
  Mounting mounting;
  Inputs<double> in;
  in.mounting = &mounting;
  in.f_p = Vec3(0.48, -0.36, 0.80);
  in.omega_ic_p = Vec3(3e-5, -5e-5, 4e-5);
  in.omega_cmd_p = Vec3(2e-3, -1e-3, 3e-3);
  for (const CouplingFacts& c : couplings) {
    if (!c.lambda) continue;
    DriftModel model{c.value, TermLibrary::terms_of(base_parameters()), mounting};
    const Vec3 own = platform_rate(model, in, theta.data(), Mat3::Zero());
    theta[closure_param] = value_left_out(closure_param, c.value);
    model.coupling = family_of(c.value);
    model.terms.set(*TermLibrary::find_term(closure_term));
    EXPECT_EQ(model.coupling, Coupling::lambda);
    EXPECT_LT((platform_rate(model, in, theta.data(), Mat3::Zero()) - own).norm(), 1e-18) << c.name;
  }
}

TEST(Closure, StandsBehindTheBaseTerms) {
  int base = 0;
  for (const TermInfo& term : TermLibrary::terms) base += is_base(term);
  EXPECT_EQ(base, 6);
  EXPECT_FALSE(is_base(TermLibrary::owner(closure_param)));
}

}  // namespace
}  // namespace drift::coupling_test
