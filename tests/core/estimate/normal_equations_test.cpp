#include "core/estimate/normal_equations.hpp"

#include <gtest/gtest.h>

#include "core/estimate/triangle.hpp"

namespace drift::normal_equations_test {
namespace {

/// Chains of random rows over 3 attitudes, n states and the residual, `scale` times as informative
/// as the prior per row.
struct Random {
  std::vector<ChainEquations> rows;
  std::vector<Vec3> psi;
  VecX x;
  Random(int chains, Eigen::Index n, double scale) : x(VecX::Random(n)) {
    for (int c = 0; c < chains; ++c) {
      rows.push_back({scale * MatX::Random(40 + 10 * c, 3 + n + 1)});
      psi.push_back(Vec3::Random());
    }
  }
  BatchEquations triangles() const {
    BatchEquations out{{}, psi, x};
    for (const ChainEquations& c : rows) out.chains.push_back(triangle(c.rows));
    return out;
  }
};

TEST(NormalEquations, GiveTheStepOfTheTriangles) {
  for (const Eigen::Index n : {1, 7, 63})
    for (const double mu : {0.0, 1e-3, 10.0})
      for (const double scale : {0.1, 1.0, 30.0}) {
        const Random problem(3, n, scale);
        const BatchEquations::Step of_products =
            NormalEquations(problem.rows, problem.psi, problem.x).solve(mu);
        const BatchEquations::Step of_triangles = problem.triangles().solve(mu);
        // Rounding times the condition, at most all rows' information over the prior's.
        const double bound = 1e-15 * 150.0 * static_cast<double>(n + 4) * (1.0 + scale * scale);
        EXPECT_LT((of_products.dx - of_triangles.dx).norm(), bound * (1.0 + of_triangles.dx.norm()))
            << n << " " << mu << " " << scale;
        for (std::size_t c = 0; c < problem.psi.size(); ++c)
          EXPECT_LT((of_products.dpsi[c] - of_triangles.dpsi[c]).norm(),
                    bound * (1.0 + of_triangles.dpsi[c].norm()));
      }
}

TEST(NormalEquations, AHeldParameterIsAsIfItWereNotThere) {
  constexpr Eigen::Index n = 6, held = 2;
  const Random problem(2, n, 1.0);
  Random without = problem;
  without.x.resize(n - 1);
  without.x << problem.x.head(held), problem.x.tail(n - 1 - held);
  for (std::size_t c = 0; c < problem.rows.size(); ++c) {
    const MatX& all = problem.rows[c].rows;
    MatX& rows = without.rows[c].rows;
    rows.resize(all.rows(), all.cols() - 1);
    rows << all.leftCols(3 + held), all.rightCols(n - held);
  }
  for (const double mu : {0.0, 0.1}) {
    const auto expected = NormalEquations(without.rows, without.psi, without.x).solve(mu);
    for (const BatchEquations::Step& step :
         {NormalEquations(problem.rows, problem.psi, problem.x).solve(mu, held),
          problem.triangles().solve(mu, held)}) {
      EXPECT_NEAR(step.dx[held], 0.0, 1e-14);
      EXPECT_LT((step.dx.head(held) - expected.dx.head(held)).norm(), 1e-11);
      EXPECT_LT((step.dx.tail(n - 1 - held) - expected.dx.tail(n - 1 - held)).norm(), 1e-11);
      for (std::size_t c = 0; c < step.dpsi.size(); ++c)
        EXPECT_LT((step.dpsi[c] - expected.dpsi[c]).norm(), 1e-11);
      EXPECT_NEAR(step.slope, expected.slope, 1e-10 * expected.slope);
    }
  }
}

TEST(NormalEquations, SlopeIsWhatAnUndampedStepLowersTheCostBy) {
  const Random problem(3, 7, 1.0);
  const auto step = NormalEquations(problem.rows, problem.psi, problem.x).solve(0.0);
  const auto cost = [&](double part) {
    double sum = (problem.x + part * step.dx).squaredNorm();
    for (std::size_t c = 0; c < problem.rows.size(); ++c) {
      const MatX& rows = problem.rows[c].rows;
      const VecX left = rows.rightCols<1>() - part * (rows.leftCols<3>() * step.dpsi[c] +
                                                      rows.middleCols(3, 7) * step.dx);
      sum += left.squaredNorm() + (problem.psi[c] + part * step.dpsi[c]).squaredNorm();
    }
    return sum;
  };
  EXPECT_NEAR(step.slope, cost(0.0) - cost(1.0), 1e-11 * cost(0.0));
}

TEST(NormalEquations, AChainOfWhichNothingWasMeasuredKeepsItsPrior) {
  Random problem(2, 4, 1.0);
  problem.rows[1].rows.resize(0, 3 + 4 + 1);
  const NormalEquations normal(problem.rows, problem.psi, problem.x);
  EXPECT_TRUE(normal.good_to(1e-6));
  EXPECT_LT((normal.solve(0.0).dpsi[1] + problem.psi[1]).norm(), 1e-15);
}

TEST(NormalEquations, SayWhenRoundingIsNoLongerSmall) {
  const Random tame(2, 5, 1.0), wild(2, 5, 1e6);
  EXPECT_TRUE(NormalEquations(tame.rows, tame.psi, tame.x).good_to(1e-6));
  EXPECT_FALSE(NormalEquations(wild.rows, wild.psi, wild.x).good_to(1e-6));
}

TEST(NormalEquations, AreNotGoodWhereARowIsNotFinite) {
  Random broken(1, 3, 1.0);
  broken.rows[0].rows(2, 1) = std::nan("");
  EXPECT_FALSE(NormalEquations(broken.rows, broken.psi, broken.x).good_to(1e-6));
}

}  // namespace
}  // namespace drift::normal_equations_test
