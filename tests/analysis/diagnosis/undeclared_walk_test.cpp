// Noise of the gyros that is not declared, beside what is missing: neither hides the other.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/report/diagnosis/report.hpp"
#include "core/sim/simulate.hpp"
#include "mc/study/study.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::diagnosis::undeclared_walk_test {
namespace {

struct Case {
  std::string plan, truth, filter;
  std::uint64_t seed = 1;
};

/// A unit of all base effects, of which the filter knows everything but its equation, its noise or
/// a prior.
Diagnosis diagnosed(const Case& c) {
  constexpr std::string_view terms =
      "terms = [\"fixed_drift\", \"g_drift\", \"g2_drift\", \"gyro_misalignment\", "
      "\"torquer_scale\", \"accelerometer\"]";
  const mc::Study study = mc::read_study_text(
      fmt::format("schema = 1\n[site]\nlatitude = \"45.75 deg\"\n[plan]\n{}\n[readout]\n"
                  "accelerometer_noise = \"5 ug\"\ngimbal_noise = \"5 arcsec\"\n[truth]\n{}\n{}\n"
                  "[[filter]]\nname = \"nominal\"\n{}\n{}\n",
                  c.plan, terms, c.truth, terms, c.filter),
      "s.toml");
  const Timeline timeline = lay_out(study.plan, study.site);
  const Simulation sim = Simulator(study.truth, study.readout).run(timeline, c.seed, 0);
  EXPECT_TRUE(sim.ode.ok());
  DiagnoseOptions options;
  options.folds = FoldMethod::linear;
  options.whiteness_draws = 0;
  options.profiles = Profiles::left_out;
  return diagnose(study.filters.front(), {timeline, study.readout, sim.measured}, {}, {}, options);
}

std::string said(const Diagnosis& d) {
  return report::diagnosis_in_brief(d).verdict;
}

/// As it was simulated, in deg/sqrt(h), within 4 sigma: such a walk shows from a dwell to its end
/// and to the next one, on three axes of twelve positions, some 70 degrees of freedom; so its log
/// has a sigma of 1 / sqrt(140).
void expect_walk(const Diagnosis& d, double walk) {
  const auto found = std::ranges::find_if(d.noise, [](const inference::NoiseFinding& f) {
    return f.component == "angle_random_walk" && f.significant;
  });
  ASSERT_NE(found, d.noise.end()) << said(d);
  EXPECT_NEAR(std::log(found->value / walk), 0.0, 4.0 / std::sqrt(140.0)) << said(d);
}

void expect_other_equation(const Diagnosis& d, double walk) {
  EXPECT_EQ(d.verdict, Verdict::named) << said(d);
  ASSERT_EQ(d.causes.size(), 1u) << said(d);
  EXPECT_EQ(d.causes.front().term, "frame_closure") << said(d);
  expect_walk(d, walk);
}

/// It was unexplained, or wrong effects were named with probability 1: the misfit is too gross for
/// its noise to be looked for.
TEST(UndeclaredWalk, HidesNoEquationInSlews) {
  const std::string plan = "preset = \"slew12\"\ndwell = \"15 min\"\nsample = \"30 s\"";
  for (const std::uint64_t seed : {3u, 4u})
    expect_other_equation(
        diagnosed({plan, "coupling = \"eq6\"\nangle_random_walk = \"0.001 deg/sqrt(h)\"",
                   "coupling = \"eq5\"", seed}),
        0.001);
}

/// It was consistent, with a noise that the wrong equation asks for, under which the two looked
/// alike.
TEST(UndeclaredWalk, MakesNoTwoEquationsAlike) {
  expect_other_equation(diagnosed({"preset = \"twentyfour\"\ndwell = \"20 min\"\nsample = \"60 s\"",
                                   "coupling = \"eq5\"\nangle_random_walk = \"0.003 deg/sqrt(h)\"",
                                   "coupling = \"eq6\"", 2}),
                        0.003);
}

/// Parameters that are right bend under the noise and were blamed with the one that is wrong.
TEST(UndeclaredWalk, BlamesNoPriorThatIsRight) {
  const Diagnosis d = diagnosed({"preset = \"twelve\"\ndwell = \"30 min\"\nsample = \"60 s\"",
                                 "coupling = \"eq5\"\nangle_random_walk = \"0.003 deg/sqrt(h)\"\n"
                                 "[truth.parameters]\ndP_x = \"5000 arcsec\"",
                                 "coupling = \"eq5\"", 1});
  EXPECT_EQ(d.verdict, Verdict::consistent) << said(d);
  const auto* beyond = remark_in<remark::BeyondPrior>(d);
  ASSERT_NE(beyond, nullptr) << said(d);
  EXPECT_TRUE(beyond->explains && beyond->noise_beside) << said(d);
  ASSERT_EQ(beyond->parameters.size(), 1u) << said(d);
  const std::size_t dP_x = test::param("dP_x");
  EXPECT_EQ(beyond->parameters.front().estimate.param, dP_x);
  EXPECT_GT(d.patched.priors[dP_x].sigma(), 4000.0 * test::arcsec);
  EXPECT_EQ(said(d).find("Or else"), std::string::npos) << said(d);
  expect_walk(d, 0.003);
}

/// Neither wrong priors nor something outside the library has 0.95 of the probability.
TEST(UndeclaredWalk, BesideAPriorThatMayBeWrongIsAmbiguousWhereNeitherIsCredible) {
  const Diagnosis d = diagnosed({"preset = \"twelve\"\ndwell = \"30 min\"\nsample = \"60 s\"",
                                 "coupling = \"eq5\"\ndrift_random_walk = \"0.005 deg/h/sqrt(h)\"\n"
                                 "[truth.parameters]\nK2_x = \"600 ug/g^2\"",
                                 "coupling = \"eq5\"", 1});
  const auto* beyond = remark_in<remark::BeyondPrior>(d);
  ASSERT_NE(beyond, nullptr) << said(d);
  EXPECT_TRUE(beyond->explains) << said(d);
  EXPECT_EQ(beyond->parameters.front().estimate.param, test::param("K2_x"));
  EXPECT_NE(d.verdict, Verdict::unexplained) << said(d);
}

}  // namespace
}  // namespace drift::diagnosis::undeclared_walk_test
