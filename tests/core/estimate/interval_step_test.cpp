#include "core/estimate/sequential/interval_step.hpp"

#include <gtest/gtest.h>

#include "core/base/check.hpp"
#include "core/estimate/sequential/interval_rows.hpp"
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

/// Second implementation: while nothing is relinearised, a filter that carries the covariance of
/// everything and rows that a filter of the attitude whitens say the same.
TEST(IntervalStep, SaysWhatTheRowsOfAnIntervalSay) {
  Bench b({"D_F", "heat", "F", "enc_s1"});
  b.filter.noise.angle_random_walk = 0.1 * detail::deg / 60.0;
  IntervalStep step(b.filter, b.timeline, Readout{});
  IntervalRows rows(b.filter, b.timeline, Readout{});
  const VecX zero = VecX::Zero(static_cast<Eigen::Index>(b.layout.size()));
  step.reset(zero, b.layout.theta);
  rows.reset(b.layout.theta);
  const Trajectory nominal = integrate_fixed(b.timeline, b.filter.model(), b.layout.theta,
                                             std::vector<Vec3>(b.timeline.chains, Vec3::Zero()));
  const Vec3 none = Vec3::Constant(std::nan(""));
  const Vec3 gimbals = b.measured.gimbal.col(0);
  const auto taken = step.process(0, none, gimbals);
  std::vector<double> whitened(3 * rows.width());
  rows.enter(0);
  rows.look_ahead(0, 1, nominal.data());
  rows.cage(b.timeline.intervals[0], nominal[0]);
  const auto triple = rows.take(0, none, gimbals, nominal.data(), nullptr, whitened.data());
  EXPECT_EQ(taken.scalars, 3);
  EXPECT_EQ(triple.scalars, 3u);
  Information information(b.layout.size(), rows.width());
  information.add(whitened.data(), 3);
  ASSERT_TRUE(information.factorise());
  const VecX x = information.solve(zero);
  EXPECT_LT((x - step.x()).norm(), 1e-12 * x.norm());
  EXPECT_NEAR(information.cost(x, zero), taken.nis, 1e-12 * taken.nis);
  MatX P(x.size(), x.size());
  information.invert(P);
  for (std::size_t k = 0; k < b.layout.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    EXPECT_NEAR(b.layout.sigma[i] * std::sqrt(P(i, i)) / step.sigma(k), 1.0, 1e-12);
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
