#include "core/estimate/interval_step.hpp"

#include <gtest/gtest.h>

#include "core/base/check.hpp"
#include "tests/support/term_scenes.hpp"

namespace drift::interval_step_test {
namespace {

using namespace drift::test;

struct Bench {
  Timeline timeline = scene("slew12", CommandLaw::level, 600.0, 120.0);
  FilterSpec filter = base_filter(Coupling::eq6);
  Layout layout;
  Measurements measured;
  explicit Bench(std::initializer_list<std::string_view> keys) {
    filter.active = TermLibrary::completed(only(keys));
    layout = make_layout(filter);
    const std::vector<Vec3> psi(timeline.chains, Vec3(4e-4, -3e-4, 5e-4));
    measured = predict(timeline, filter.model(), layout.theta, psi, Readout{});
  }
};

/// About a path of its own, a step from the estimate along that path is the step about the
/// estimate.
TEST(IntervalStep, SeesTheSameFromBothPointsOfViewWhileTheyAgree) {
  // Nothing is known of the first interval but the prior: estimate and nominal path coincide.
  Bench b({"D_F", "heat", "F", "enc_s1"});
  IntervalStep estimate(b.filter, b.timeline, Readout{}, About::estimate);
  IntervalStep reference(b.filter, b.timeline, Readout{}, About::reference);
  const VecX zero = VecX::Zero(static_cast<Eigen::Index>(b.layout.size()));
  estimate.reset(zero, b.layout.theta);
  reference.reset(zero, b.layout.theta);
  const Trajectory nominal = integrate_fixed(b.timeline, b.filter.model(), b.layout.theta,
                                             std::vector<Vec3>(b.timeline.chains, Vec3::Zero()));
  const Vec3 none = Vec3::Constant(std::nan(""));
  const auto gimbals = b.measured.gimbal.col(0);
  const auto here = estimate.process(0, none, gimbals);
  const auto there = reference.process(0, none, gimbals, nominal.data());
  EXPECT_EQ(here.scalars, 3);
  EXPECT_EQ(there.scalars, 3);
  EXPECT_EQ(here.nis, there.nis);
  EXPECT_EQ(estimate.x(), reference.x());
  EXPECT_EQ(estimate.phi(), reference.phi());
}

TEST(IntervalStep, DemandsAReferenceAndOnlyWhereItLinearisesAboutOne) {
  Bench b({"D_F"});
  const VecX zero = VecX::Zero(3);
  for (const About about : {About::estimate, About::reference}) {
    IntervalStep step(b.filter, b.timeline, Readout{}, about);
    step.reset(zero, b.layout.theta);
    const Vec3 phi = Vec3::Zero();
    EXPECT_THROW(step.process(0, b.measured.acc.col(0), b.measured.gimbal.col(0),
                              about == About::estimate ? &phi : nullptr),
                 ContractError);
  }
}

TEST(Linearizer, DemandsTheTimeAndTheMemoryThatTermsLookAt) {
  Bench b({"D_F", "heat"});
  Linearizer linearizer(b.filter.model(), b.layout, Readout{});
  NodeJacobian j = linearizer.make();
  const Interval& interval = b.timeline.intervals[0];
  const auto evaluate = [&](const Timeline* timeline) {
    linearizer.evaluate({{{&b.timeline.nodes[0], &interval}}}, Mat3::Zero(), timeline, &j);
  };
  EXPECT_THROW(evaluate(&b.timeline), ContractError);
  EXPECT_THROW(evaluate(nullptr), ContractError);
}

}  // namespace
}  // namespace drift::interval_step_test
