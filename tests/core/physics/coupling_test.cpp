#include "core/physics/coupling.hpp"

#include <gtest/gtest.h>

#include "core/physics/closure.hpp"
#include "core/physics/coupling_names.hpp"
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

TEST(Coupling, ALoopThatBelievesNothingClosesOverWhatTheTableSays) {
  Mat3 E;
  E << 0.0, 3e-4, -5e-4, 2e-4, 0.0, 7e-4, -1e-4, 6e-4, 0.0;
  const auto part = [&](Coupling coupling) -> Mat3 {
    return closed_over(coupling, E, 0.37, Mat3::Zero()).K;
  };
  for (const CouplingFacts& c : couplings) {
    EXPECT_EQ(part(c.compensating_nothing), part(c.value)) << c.name;
    // What it is then, and what it settles to, is that for good.
    EXPECT_EQ(facts(c.compensating_nothing).compensating_nothing, c.compensating_nothing);
    EXPECT_TRUE(is_algebraic(c.settles_to)) << c.name;
  }
}

TEST(Coupling, IsListedFromTheTable) {
  const std::string all = names_of_couplings(), equations = names_of_equations();
  for (const CouplingFacts& c : couplings) {
    const std::string quoted = '"' + std::string(c.name) + '"';
    EXPECT_NE(all.find(quoted), std::string::npos) << all;
    EXPECT_EQ(equations.find(quoted) != std::string::npos,
              c.value != Coupling::servo && c.value != Coupling::compensated)
        << equations;
  }
  EXPECT_EQ(names_of_couplings(is_algebraic).find("servo"), std::string::npos);
}

TEST(Closure, StandsBehindTheBaseTerms) {
  int base = 0;
  for (const TermInfo& term : TermLibrary::terms) base += is_base(term);
  EXPECT_EQ(base, 6);
  EXPECT_FALSE(is_base(TermLibrary::owner(closure_param)));
}

}  // namespace
}  // namespace drift::coupling_test
