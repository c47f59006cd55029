#include "analysis/observability/pwcs.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <string>

#include "tests/support/model_builders.hpp"

namespace drift::pwcs_test {
namespace {

using test::harbin;

TestPlan plan_of(std::string_view preset, std::size_t first = 0, std::size_t count = 1000) {
  TestPlan plan = preset_plan(preset, {}).value();
  auto& p = plan.positions;
  p.erase(p.begin(), p.begin() + static_cast<std::ptrdiff_t>(first));
  if (p.size() > count) p.resize(count);
  return plan;
}

/// The 24 cardinal positions, and each of them turned by 45 deg about each platform axis.
TestPlan cardinal_and_45() {
  TestPlan plan = plan_of("twentyfour");
  const std::vector<Position> cardinal = plan.positions;
  for (int axis = 0; axis < 3; ++axis)
    for (Position p : cardinal) {
      p.R_lp = p.R_lp * rotation<double>(45.0 * detail::deg * Vec3::Unit(axis));
      plan.positions.push_back(p);
    }
  return plan;
}

/// Two opposite headings per up-axis, with North always along y_p (x vertical) or x_p (y or z
/// vertical). What the gyros sense along z_p then never changes with the heading.
TestPlan north_in_two_axes() {
  TestPlan plan = plan_of("twentyfour");
  std::erase_if(plan.positions, [](const Position& p) {
    const Vec3 north_p = p.R_lp.row(0);
    const bool x_vertical = std::abs(p.R_lp(2, 0)) > 0.5;
    return std::abs(north_p[x_vertical ? 1 : 0]) < 0.5;
  });
  return plan;
}

Readout channels(bool gimbals) {
  Readout readout;
  readout.gimbals = gimbals;
  return readout;
}

struct Case {
  const char* name;
  TestPlan plan;
  int acc, acc_enc;  ///< rank, physics.md 2.5
};

std::vector<Case> table() {
  return {{"1 position", plan_of("six", 0, 1), 6, 9},
          {"6 cardinal", plan_of("six"), 34, 36},
          {"Apollo 1 to 6", plan_of("apollo10", 0, 6), 34, 36},
          {"Apollo 1 to 10", plan_of("apollo10"), 51, 52},
          // The reference's 42 needs headings that leave an axis out; preset twelve sees all three.
          {"12 cardinal, North in two axes", north_in_two_axes(), 42, 42},
          {"12 cardinal", plan_of("twelve"), 45, 45},
          {"24 cardinal", plan_of("twentyfour"), 45, 45},
          {"24 cardinal and 72 at 45 deg", cardinal_and_45(), 60, 60}};
}

TEST(Pwcs, RanksOfTheTable) {
  ASSERT_EQ(north_in_two_axes().positions.size(), 12u);
  for (const Coupling coupling : {Coupling::eq5, Coupling::eq6})
    for (const Case& c : table())
      for (const bool gimbals : {false, true}) {
        const observability::PwcsRank r =
            observability::pwcs_rank(c.plan, harbin, test::base_spec(coupling), channels(gimbals));
        EXPECT_EQ(r.states, 63);
        EXPECT_EQ(r.rank, gimbals ? c.acc_enc : c.acc) << c.name << ", gimbals " << gimbals;
        EXPECT_TRUE(r.clear()) << c.name << ", gimbals " << gimbals << ": gap " << r.gap
                               << ", leak " << r.leak << ", least "
                               << r.singular_values.transpose();
      }
}

TEST(Pwcs, NullSpaceOfACardinalPositionStandsStill) {
  for (const bool gimbals : {false, true})
    for (const observability::PwcsPosition& p : observability::pwcs_positions(
             plan_of("twentyfour"), harbin, test::base_spec(Coupling::eq5), channels(gimbals))) {
      // The null space of Q by another route than pwcs_rank takes: complement of the range of Q^T.
      Eigen::ColPivHouseholderQR<MatX> qr(p.Q.transpose());
      qr.setThreshold(1e-9);
      const MatX basis = qr.householderQ() * MatX::Identity(63, 63);
      const MatX null = basis.rightCols(63 - qr.rank());
      ASSERT_EQ(qr.rank(), gimbals ? 9 : 6);
      ASSERT_LT((p.Q * null).norm(), 1e-12 * p.Q.norm());
      EXPECT_LT((p.F * null).norm(), 1e-12 * p.F.norm());
    }
}

TEST(Pwcs, ConditionFailsWhereNothingCouplesAzimuthIntoTilt) {
  // On the pole the horizontal Earth rate is gone: azimuth drift moves an unseen azimuth.
  const observability::PwcsRank pole =
      observability::pwcs_rank(plan_of("six", 4, 1), Site{90.0 * detail::deg},
                               test::base_spec(Coupling::eq5), channels(false));
  EXPECT_GT(pole.leak, 1e-3);
  EXPECT_FALSE(pole.clear());
}

TEST(Pwcs, FixedDriftAndTraceOfG2AreOneSum) {
  const ModelSpec spec = test::base_spec(Coupling::eq5);
  const Layout layout = make_layout(spec);
  const observability::PwcsRank r =
      observability::pwcs_rank(cardinal_and_45(), harbin, spec, channels(true));
  ASSERT_EQ(r.null_space.cols(), 3);
  for (const char axis : {'x', 'y', 'z'}) {
    Theta direction = Theta::Zero();  // D_F + t, D_II = D_OO = D_SS = -t: the same drift at 1 g
    direction[test::param(std::string("D_F_") + axis)] = 1.0;
    for (const char* key : {"D_II_", "D_OO_", "D_SS_"})
      direction[test::param(std::string(key) + axis)] = -1.0;
    VecX v = VecX::Zero(r.states);
    v.tail(static_cast<Eigen::Index>(layout.size())) = layout.scaled(direction);
    v.normalize();
    EXPECT_LT((v - r.null_space * (r.null_space.transpose() * v)).norm(), 1e-9) << axis;
  }
}

TEST(Pwcs, OneMoreKnownParameterIsOneStateLess) {
  ModelSpec spec = test::base_spec(Coupling::eq5);
  spec.active &= ~test::only({"D_II_x", "D_II_y", "D_II_z"});
  const observability::PwcsRank r =
      observability::pwcs_rank(cardinal_and_45(), harbin, spec, channels(false));
  EXPECT_EQ(r.states, 60);
  EXPECT_EQ(r.rank, 60);
  EXPECT_EQ(r.null_space.cols(), 0);
}

TEST(Pwcs, TermsWithTimeOrMemoryHaveNoPartInAConstantProblem) {
  const FilterSpec plain = test::base_filter(Coupling::eq5);
  for (const char* key :
       {"ramp_x", "W_x", "dD_I_y", "R_z", "tilt_s_n", "F_outer", "enc_s1_outer"}) {
    FilterSpec more = plain;
    const std::size_t i = test::param(key);
    more.active.set(i);
    more.priors[i] = TermLibrary::specs[i].prior_si();
    const observability::PwcsRank rank =
        observability::pwcs_rank(plan_of("six"), harbin, more, channels(true));
    EXPECT_EQ(rank.rank, 36) << key;
    EXPECT_EQ(rank.states, 64) << key;
  }
}

}  // namespace
}  // namespace drift::pwcs_test
