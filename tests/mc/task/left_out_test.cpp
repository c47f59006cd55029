// Is a filter of a study the model that made the data? If not, what of the truth does it leave out?
#include "mc/task/left_out.hpp"

#include <gtest/gtest.h>

#include "tests/mc/task/models_with.hpp"
#include "tests/support/own_terms.hpp"

namespace drift::left_out_test {
namespace {

using namespace drift::test;
using Names = std::vector<std::string>;

/// As a study file names them.
Names missing(const mc::LeftOut& left_out) {
  return terms_text(TermLibrary::completed(left_out.parameters));
}

TEST(LeftOut, IsEveryTermOfTheTruthThatTheFilterDoesNotHave) {
  const OwnTermsHeld own(own_term("rumble", "rate.y", "A*sin(2*pi*t/P)",
                                  "A = { unit = 'deg/h', prior = 0.05 }, P = { unit = 'min', value "
                                  "= 37 }"));
  for (const TermInfo& term : TermLibrary::terms) {
    if (term.key == closure_term) continue;  // which is the equation
    const TruthSpec truth = truth_with({term.key});
    const FilterSpec with = filter_with({term.key, "azimuth_error"});
    EXPECT_TRUE(mc::left_out(truth, with).nothing()) << term.key;
    const FilterSpec without = filter_with({term.key == "g_drift" ? "g2_drift" : "g_drift"});
    const mc::LeftOut left_out = mc::left_out(truth, without);
    EXPECT_EQ(missing(left_out), (Names{std::string(term.key)}));
    EXPECT_FALSE(left_out.nothing() || left_out.equation || left_out.held.any()) << term.key;
  }
}

TEST(LeftOut, IsNoEffectOfSizeZero) {
  TruthSpec truth = truth_with({"fixed_drift", "accelerometer_ramp", "bistable_drift"});
  const FilterSpec filter = filter_with({"fixed_drift", "bistable_drift"});
  for (const char* key : {"K0_ramp_y", "K0_ramp_z"}) truth.priors[param(key)] = fixed(0.0);
  EXPECT_EQ(missing(mc::left_out(truth, filter)), (Names{"accelerometer_ramp.x"}));
  truth.priors[param("K0_ramp_x")] = fixed(0.0);
  EXPECT_TRUE(mc::left_out(truth, filter).nothing());
  // A telegraph of no size lasts on average as long as any.
  const FilterSpec still = filter_with({"fixed_drift"});
  EXPECT_EQ(missing(mc::left_out(truth, still)), (Names{"bistable_drift"}));
  for (const char* key : {"B_x", "B_y", "B_z"}) truth.priors[param(key)] = fixed(0.0);
  EXPECT_TRUE(mc::left_out(truth, still).nothing());
}

TEST(LeftOut, IsWhatTheFilterTakesForAnotherConstant) {
  const std::size_t tau = param("W_tau");
  TruthSpec truth = truth_with({"warmup_drift"});
  FilterSpec filter = filter_with({"warmup_drift"});
  truth.priors[tau] = fixed(1200.0);
  EXPECT_EQ(mc::left_out(truth, filter).held, ParamMask().set(tau));
  filter.priors[tau] = fixed(20.0 * unit::minute.to_si);
  EXPECT_TRUE(mc::left_out(truth, filter).nothing());
  truth.priors[tau] = normal(1200.0, 60.0);
  EXPECT_EQ(mc::left_out(truth, filter).held, ParamMask().set(tau)) << "in every run another";
  filter.priors[tau] = normal(2400.0, 600.0);
  EXPECT_TRUE(mc::left_out(truth, filter).nothing()) << "estimated";
  truth.priors[param("W_x")] = truth.priors[param("W_y")] = truth.priors[param("W_z")] = fixed(0.0);
  truth.priors[tau] = fixed(1200.0);
  filter.priors[tau] = fixed(2400.0);
  EXPECT_TRUE(mc::left_out(truth, filter).nothing()) << "of an effect that is none";
}

TEST(LeftOut, IsProcessNoiseWhateverItIsCalled) {
  TruthSpec truth = truth_with({"fixed_drift"});
  truth.noise = {.angle_random_walk = 1e-6, .drift_random_walk = 1e-9};
  FilterSpec filter = filter_with({"fixed_drift"});
  using Keys = std::vector<std::string_view>;
  EXPECT_EQ(mc::left_out(truth, filter).noise, (Keys{"drift_random_walk", "angle_random_walk"}));
  filter.noise.angle_random_walk = 1e-6;
  EXPECT_EQ(mc::left_out(truth, filter).noise, (Keys{"drift_random_walk"}));
  filter.active |= params_named("drift_random_walk");
  for (const char* q : {"q_x", "q_y", "q_z"}) filter.priors[param(q)] = fixed(1e-9);
  EXPECT_TRUE(mc::left_out(truth, filter).nothing()) << "the term is the same noise";
  truth = truth_with({"fixed_drift", "drift_random_walk"});
  filter = filter_with({"fixed_drift"});
  filter.noise.drift_random_walk = 1e-9;
  EXPECT_TRUE(mc::left_out(truth, filter).nothing()) << "and the other way round";
}

TEST(LeftOut, IsNoiseThatTheFilterHasLessOf) {
  // Of what is smaller the sigmas are too small; of what is larger they are only too large.
  using Keys = std::vector<std::string_view>;
  TruthSpec truth = truth_with({"fixed_drift"});
  truth.noise = {.angle_random_walk = 1e-6, .drift_random_walk = 1e-9};
  FilterSpec filter = filter_with({"fixed_drift"});
  filter.noise = truth.noise;
  EXPECT_TRUE(mc::left_out(truth, filter).nothing());
  filter.noise = {.angle_random_walk = 2e-6, .drift_random_walk = 2e-9};
  filter.initial_attitude = 2.0 * truth.initial_attitude;
  EXPECT_TRUE(mc::left_out(truth, filter).nothing());
  filter.noise = {.angle_random_walk = 1e-8, .drift_random_walk = 1e-11};
  filter.initial_attitude = 0.01 * truth.initial_attitude;
  const mc::LeftOut less = mc::left_out(truth, filter);
  EXPECT_EQ(less.smaller_keys,
            (Keys{"drift_random_walk", "angle_random_walk", "initial_attitude"}));
  EXPECT_TRUE(less.noise.empty() && less.parameters.none() && !less.nothing());
}

TEST(LeftOut, IsNoiseOfATermThatTheFilterHasLessOf) {
  TruthSpec truth = truth_with({"fixed_drift", "drift_random_walk", "bistable_drift"});
  FilterSpec filter = filter_with({"fixed_drift", "drift_random_walk", "bistable_drift"});
  EXPECT_TRUE(mc::left_out(truth, filter).nothing()) << "drawn from what it believes";
  filter.priors[param("q_y")] = fixed(truth.priors[param("q_y")].a);  // the least it may be
  filter.priors[param("B_z")] = fixed(truth.priors[param("B_z")].a);
  EXPECT_EQ(mc::left_out(truth, filter).smaller, ParamMask().set(param("q_y")).set(param("B_z")));
  filter.priors[param("q_y")] = fixed(truth.priors[param("q_y")].b);  // the most
  filter.priors[param("B_z")] = fixed(truth.priors[param("B_z")].b);
  EXPECT_TRUE(mc::left_out(truth, filter).nothing());
  filter.priors[param("B_dwell")] = fixed(2.0 * truth.priors[param("B_dwell")].a);
  EXPECT_EQ(mc::left_out(truth, filter).held, ParamMask().set(param("B_dwell")))
      << "levels that last longer give the drift less room";
}

TEST(LeftOut, IsWhatAPriorExcludes) {
  const std::size_t i = param("D_F_x");
  const TruthSpec truth = truth_with({"fixed_drift"});
  FilterSpec filter = filter_with({"fixed_drift"});
  const double sigma = truth.priors[i].sigma();
  const auto excluded = [&](const Prior& own) {
    filter.priors[i] = own;
    const mc::LeftOut out = mc::left_out(truth, filter);
    EXPECT_EQ(out.nothing(), out.excluded.none());
    return out.excluded == ParamMask().set(i);
  };
  EXPECT_FALSE(excluded(normal(0.0, 0.21 * sigma)));
  EXPECT_TRUE(excluded(normal(0.0, 0.19 * sigma))) << "root mean square beyond 5 sigma";
  EXPECT_TRUE(excluded(normal(6.0 * sigma, sigma)));
  EXPECT_FALSE(excluded(normal(6.0 * sigma, 6.0 * sigma)));
}

TEST(LeftOut, IsNoEquationWhereNothingIsMisaligned) {
  // Without a misalignment eq. (5) and eq. (6) are one: only what is left out itself is missing.
  const auto wrong = [](const TruthSpec& truth, const FilterSpec& filter) {
    return mc::left_out(truth, filter).equation;
  };
  using enum Coupling;
  const TruthSpec plain = truth_with({"fixed_drift", "g_drift"});
  EXPECT_FALSE(wrong(plain, filter_with({"fixed_drift", "g_drift"}, eq6)));
  EXPECT_FALSE(wrong(plain, filter_with({"fixed_drift", "g_drift", "gyro_misalignment"}, eq6)));
  TruthSpec zero = truth_with({"fixed_drift", "gyro_misalignment", "misalignment_creep"});
  const FilterSpec other = filter_with({"fixed_drift", "gyro_misalignment"}, eq6);
  EXPECT_TRUE(wrong(zero, other));
  for (const char* term : {"gyro_misalignment", "misalignment_creep"}) {
    const ParamMask params = params_named(term);
    for (std::size_t i = 0; i < params.size(); ++i)
      if (params[i]) zero.priors[i] = fixed(0.0);
    EXPECT_EQ(wrong(zero, other), std::string_view(term) == "gyro_misalignment")
        << "a creep is a misalignment, too";
  }
  const TruthSpec tilted = truth_with({"fixed_drift", "gyro_misalignment"});
  EXPECT_EQ(missing(mc::left_out(tilted, filter_with({"fixed_drift"}, eq6))),
            (Names{"gyro_misalignment"}));
  EXPECT_FALSE(wrong(tilted, filter_with({"fixed_drift"}, eq6)));
  // A loop that compensates something, and floats that leak, act without any.
  TruthSpec loop = truth_with({"fixed_drift"}, compensated);
  loop.theta_loop[param("eta_x")] = 1e-3;
  EXPECT_TRUE(wrong(loop, filter_with({"fixed_drift"}, eq5)));
  TruthSpec spring = truth_with({"fixed_drift"}, servo);
  EXPECT_FALSE(wrong(spring, filter_with({"fixed_drift"}, eq5)));
  spring.servo.float_restraint = 0.1;
  EXPECT_TRUE(wrong(spring, filter_with({"fixed_drift"}, eq6)));
}

TEST(LeftOut, IsAMotionOfTheBaseThatNoFilterHas) {
  TruthSpec truth = truth_with({"fixed_drift"}, Coupling::servo);
  const FilterSpec filter = filter_with({"fixed_drift"}, Coupling::eq6);
  truth.servo.base_amplitude = 1e-3;
  EXPECT_TRUE(mc::left_out(truth, filter).nothing()) << "it stands still at 0 Hz";
  truth.servo.base_frequency = 0.2;
  EXPECT_EQ(mc::left_out(truth, filter).noise,
            (std::vector<std::string_view>{"servo.base_amplitude"}));
}

TEST(LeftOut, IsAnEquationThatClosesOverAnotherPart) {
  // Whatever couplings there are: equations are the same where what the loop closes over is, K. For
  // a filter that estimates lambda it may be any part of E; 0.37 is none that has a name.
  Mat3 E;
  E << 0.0, 3e-4, -5e-4, 2e-4, 0.0, 7e-4, -1e-4, 6e-4, 0.0;
  const auto part = [&](Coupling coupling) -> Mat3 {
    return closed_over(coupling, E, 0.37, Mat3::Zero()).K;
  };
  for (const CouplingFacts& truth : couplings)
    for (const CouplingFacts& filter : couplings) {
      if (!is_algebraic(filter.value)) continue;
      const Mat3 K = part(truth.settles_to);
      const Mat3 nearest = filter.value == Coupling::lambda
                               ? Mat3(E * (K.cwiseProduct(E).sum() / E.squaredNorm()))
                               : part(filter.value);
      const bool another = (K - nearest).norm() > 1e-12 * E.norm();  // rounding is 1e-16
      EXPECT_EQ(mc::left_out(truth_with({"gyro_misalignment"}, truth.value),
                             filter_with({"gyro_misalignment"}, filter.value))
                    .equation,
                another)
          << truth.name << " with " << filter.name;
    }
}

TEST(LeftOut, IsAnotherEquation) {
  const auto other = [](const TruthSpec& truth, Coupling filter) {
    return mc::left_out(truth, filter_with({"gyro_misalignment"}, filter)).equation;
  };
  const auto truth = [](Coupling coupling) { return truth_with({"gyro_misalignment"}, coupling); };
  using enum Coupling;
  for (const Coupling filter : {eq5, eq6, Coupling::lambda, compensated}) {
    EXPECT_EQ(other(truth(eq5), filter), filter == eq6) << key_of(filter);
    EXPECT_EQ(other(truth(eq6), filter), filter != eq6 && filter != Coupling::lambda);
    EXPECT_EQ(other(truth(servo), filter), filter != eq6 && filter != Coupling::lambda);
    EXPECT_EQ(other(truth(compensated), filter), filter == eq6) << "it compensates nothing";
  }
  TruthSpec spring = truth(servo);
  spring.servo.float_restraint = 0.1;
  EXPECT_TRUE(other(spring, eq6));
  TruthSpec loop = truth(compensated);
  loop.theta_loop[param("eta_x")] = 1e-3;
  EXPECT_TRUE(other(loop, eq5));
  EXPECT_FALSE(other(loop, compensated));
  TruthSpec between = truth(Coupling::lambda);
  EXPECT_TRUE(other(between, eq5)) << "drawn anew in every run";
  between.priors[closure_param] = fixed(0.0);
  EXPECT_FALSE(other(between, eq5));
  FilterSpec half = filter_with({"gyro_misalignment"}, Coupling::lambda);
  half.priors[closure_param] = fixed(0.5);
  EXPECT_TRUE(mc::left_out(truth(eq6), half).equation);
}

TEST(LeftOut, IsAnEquationThatThePriorOfLambdaExcludes) {
  using enum Coupling;
  FilterSpec filter = filter_with({"gyro_misalignment"}, Coupling::lambda);
  const auto excluded = [&](Coupling truth, const Prior& own) {
    filter.priors[closure_param] = own;
    const mc::LeftOut out = mc::left_out(truth_with({"gyro_misalignment"}, truth), filter);
    EXPECT_FALSE(out.equation) << "it is estimated";
    EXPECT_EQ(out.nothing(), out.excluded.none());
    return out.excluded == ParamMask().set(closure_param);
  };
  // 5 sigmas of a prior about 0.3 reach 1 where a sigma is 0.14, and 0 where it is 0.06.
  for (const Coupling truth : {eq6, servo}) {
    EXPECT_TRUE(excluded(truth, normal(0.3, 0.01)));
    EXPECT_TRUE(excluded(truth, normal(0.3, 0.139)));
    EXPECT_FALSE(excluded(truth, normal(0.3, 0.141)));
    EXPECT_TRUE(excluded(truth, uniform(0.0, 0.1)));  // 0.95 from its mean, 33 of its sigmas
    EXPECT_FALSE(excluded(truth, uniform(0.0, 1.0)));
  }
  for (const Coupling truth : {eq5, compensated}) {
    EXPECT_TRUE(excluded(truth, normal(0.3, 0.059)));
    EXPECT_FALSE(excluded(truth, normal(0.3, 0.061)));
  }
  // Without misalignments any lambda does.
  filter.priors[closure_param] = normal(0.3, 0.01);
  EXPECT_TRUE(mc::left_out(truth_with({"fixed_drift"}, eq6), filter).excluded.none());
}

TEST(LeftOut, TruthsAreDrawnFromWhatAFilterBelievesWherePriorsAndNoiseAreItsOwn) {
  const auto drawn = [](const TruthSpec& truth, const FilterSpec& filter) {
    return mc::drawn_from_beliefs(truth, filter);
  };
  const TruthSpec truth = truth_with({"fixed_drift", "gyro_misalignment"});
  const FilterSpec filter = filter_with({"fixed_drift", "gyro_misalignment"});
  EXPECT_TRUE(drawn(truth, filter));
  EXPECT_FALSE(drawn(truth, filter_with({"fixed_drift"}))) << "left out";
  EXPECT_FALSE(drawn(truth_with({"fixed_drift"}), filter)) << "zero, which the filter knows not";
  EXPECT_FALSE(drawn(truth_with({"fixed_drift", "gyro_misalignment"}, Coupling::servo),
                     filter_with({"fixed_drift", "gyro_misalignment"}, Coupling::eq6)));
  TruthSpec other = truth;
  other.priors[param("D_F_x")] = fixed(0.0);
  EXPECT_TRUE(mc::left_out(other, filter).nothing());
  EXPECT_FALSE(drawn(other, filter));
  other = truth;
  other.initial_attitude *= 2.0;
  EXPECT_FALSE(drawn(other, filter));
  FilterSpec cautious = filter;
  cautious.noise.drift_random_walk = 1e-9;
  EXPECT_FALSE(drawn(truth, cautious));
  FilterSpec elsewhere = filter;
  elsewhere.starts.assign(1, Start{});
  EXPECT_TRUE(drawn(truth, elsewhere));
  elsewhere.starts.front() = {{param("D_F_x"), 1e-6}};
  EXPECT_FALSE(drawn(truth, elsewhere));
}

}  // namespace
}  // namespace drift::left_out_test
