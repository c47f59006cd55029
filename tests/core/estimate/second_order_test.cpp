#include "core/estimate/descent/second_order.hpp"

#include <gtest/gtest.h>

namespace drift::second_order_test {
namespace {

/// Samples of a x + q x^2 / 2 at two parameters, of which the first bends; one chain whose attitude
/// they do not see.
Evaluation at(double x0, double x1) {
  constexpr Eigen::Index samples = 3;
  const Eigen::Vector3d a(1.0, -2.0, 0.5), b(0.3, 1.0, 2.0), q(2.0, -1.0, 4.0),
      data(5.0, 1.0, -3.0);
  Evaluation e;
  e.x = Eigen::Vector2d(x0, x1);
  e.psi = {Vec3::Zero()};
  MatX rows = MatX::Zero(samples, 3 + 2 + 1);
  rows.col(3) = a + q * x0;
  rows.col(4) = b;
  rows.col(5) = data - (a * x0 + 0.5 * q * x0 * x0 + b * x1);
  e.rows.push_back({rows});
  e.cost = e.data_cost() + e.x.squaredNorm();
  return e;
}

TEST(SecondOrder, OfAParabolaIsMinusItsBendTimesTheResiduals) {
  const Evaluation from = at(0.2, -0.4), to = at(0.5, -0.4);
  SecondOrder second;
  second.learn(from, to);
  const Eigen::Vector3d q(2.0, -1.0, 4.0);
  ASSERT_EQ(second.matrix().rows(), 2);
  EXPECT_NEAR(second.matrix()(0, 0), -q.dot(to.rows[0].rows.col(5)), 1e-13);
  EXPECT_EQ(second.matrix()(1, 1), 0.0);
  EXPECT_EQ(second.matrix()(0, 1), 0.0);
}

TEST(SecondOrder, GivesTheChangeOfTheRowsOfTheLastStep) {
  const Evaluation first = at(0.2, -0.4), middle = at(0.5, 0.3), last = at(0.4, 0.9);
  SecondOrder second;
  second.learn(first, middle);
  second.learn(middle, last);
  const MatX change = middle.rows[0].rows.middleCols(3, 2) - last.rows[0].rows.middleCols(3, 2);
  const VecX bent = change.transpose() * last.rows[0].rows.col(5);
  EXPECT_LT((second.matrix() * (last.x - middle.x) - bent).norm(), 1e-12);
  EXPECT_LT((second.matrix() - second.matrix().transpose()).norm(), 1e-12);
}

TEST(SecondOrder, IsForgottenWhereThereAreOtherRows) {
  const Evaluation from = at(0.2, -0.4), to = at(0.5, -0.4);
  SecondOrder second;
  second.learn(from, to);
  Evaluation shorter = to;
  shorter.rows[0].rows.conservativeResize(2, Eigen::NoChange);
  second.learn(to, shorter);
  EXPECT_EQ(second.matrix().size(), 0);
}

TEST(SecondOrder, NothingIsLearntOfALinearModel) {
  Evaluation from = at(0.2, -0.4), to = at(0.2, 0.7);  // along the one that does not bend
  SecondOrder second;
  second.learn(from, to);
  EXPECT_EQ(second.matrix().norm(), 0.0);
}

}  // namespace
}  // namespace drift::second_order_test
