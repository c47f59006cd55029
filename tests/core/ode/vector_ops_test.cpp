#include "core/ode/vector_ops.hpp"

#include <gtest/gtest.h>
#include <nvector/nvector_serial.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace drift::detail::vector_ops_test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Own vectors and the library's, with the same random content.
class VectorOps : public ::testing::TestWithParam<int> {
 protected:
  static constexpr int count = 6;
  void SetUp() override {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> number(0.1, 2.0);
    for (int k = 0; k < count; ++k) {
      own_[k] = make_vector(GetParam(), context_.get());
      library_[k].reset(N_VNew_Serial(GetParam(), context_.get()));
      for (int i = 0; i < GetParam(); ++i)
        NV_Ith_S(own_[k], i) = NV_Ith_S(library_[k], i) = (random() % 2 ? 1 : -1) * number(random);
    }
  }
  /// Runs `op` on both sets and compares every vector to rounding.
  void expect_same(auto op, const char* what) {
    const auto a = pointers(own_), b = pointers(library_);
    op(a.data());
    op(b.data());
    for (int k = 0; k < count; ++k)
      for (int i = 0; i < GetParam(); ++i)
        ASSERT_NEAR(NV_Ith_S(a[k], i), NV_Ith_S(b[k], i), 40.0 * eps)
            << what << " " << k << " " << i;
  }
  void expect_same_value(auto op, const char* what) {
    const double a = op(pointers(own_).data()), b = op(pointers(library_).data());
    EXPECT_NEAR(a, b, 4.0 * eps * GetParam() * (1.0 + std::abs(b))) << what;
  }
  static std::array<N_Vector, count> pointers(const std::array<VectorPtr, count>& owners) {
    std::array<N_Vector, count> p;
    for (int k = 0; k < count; ++k) p[k] = owners[k].get();
    return p;
  }
  ContextPtr context_ = make_context();
  std::array<VectorPtr, count> own_, library_;
};

TEST_P(VectorOps, ElementwiseOperationsAreThoseOfTheLibrary) {
  expect_same([](const N_Vector* v) { N_VLinearSum(1.5, v[0], -0.3, v[1], v[2]); }, "linearsum");
  expect_same([](const N_Vector* v) { N_VLinearSum(1.0, v[0], 2.0, v[1], v[1]); },
              "linearsum onto y");
  expect_same([](const N_Vector* v) { N_VProd(v[0], v[1], v[3]); }, "prod");
  expect_same([](const N_Vector* v) { N_VDiv(v[0], v[5], v[3]); }, "div");
  expect_same([](const N_Vector* v) { N_VScale(-0.7, v[4], v[4]); }, "scale in place");
  expect_same([](const N_Vector* v) { N_VAbs(v[4], v[3]); }, "abs");
  expect_same([](const N_Vector* v) { N_VInv(v[5], v[2]); }, "inv");
  expect_same([](const N_Vector* v) { N_VAddConst(v[0], 0.25, v[1]); }, "addconst");
  expect_same([](const N_Vector* v) { N_VConst(3.5, v[2]); }, "const");
}

TEST_P(VectorOps, ReductionsAreThoseOfTheLibrary) {
  const double n = GetParam();
  expect_same_value([](N_Vector* v) { return N_VDotProd(v[0], v[1]); }, "dotprod");
  expect_same_value([](N_Vector* v) { return N_VMaxNorm(v[0]); }, "maxnorm");
  expect_same_value([](N_Vector* v) { return N_VMin(v[0]); }, "min");
  expect_same_value([](N_Vector* v) { return N_VL1Norm(v[0]); }, "l1norm");
  expect_same_value([](N_Vector* v) { return N_VWL2Norm(v[0], v[1]); }, "wl2norm");
  expect_same_value([](N_Vector* v) { return N_VWrmsNorm(v[0], v[1]); }, "wrmsnorm");
  expect_same_value([](N_Vector* v) { return N_VWrmsNormMask(v[0], v[1], v[2]); }, "wrmsnormmask");
  expect_same_value([](N_Vector* v) { return N_VWSqrSumLocal(v[0], v[1]); }, "wsqrsum");
  expect_same_value([](N_Vector* v) { return N_VWSqrSumMaskLocal(v[0], v[1], v[2]); },
                    "wsqrsummask");
  N_Vector ones = own_[0].get();
  N_VConst(2.0, ones);
  EXPECT_EQ(N_VDotProd(ones, ones), 4.0 * n);
  EXPECT_EQ(N_VWrmsNorm(ones, ones), 4.0);
}

TEST_P(VectorOps, FusedOperationsAreThoseOfTheLibraryAlsoInPlace) {
  std::array<double, 3> c{0.5, -1.25, 2.0};
  for (auto& v : library_) N_VEnableFusedOps_Serial(v.get(), SUNTRUE);
  expect_same(
      [&](const N_Vector* v) {
        std::array<N_Vector, 3> x{v[0], v[1], v[2]};
        N_VLinearCombination(3, c.data(), x.data(), v[3]);
      },
      "linearcombination");
  expect_same(
      [&](const N_Vector* v) {
        std::array<N_Vector, 3> x{v[0], v[1], v[2]};
        N_VLinearCombination(3, c.data(), x.data(), v[0]);
      },
      "linearcombination in place");
  expect_same(
      [&](const N_Vector* v) {
        std::array<N_Vector, 2> y{v[1], v[2]};
        N_VScaleAddMulti(2, c.data(), v[0], y.data(), y.data());
      },
      "scaleaddmulti");
  expect_same(
      [&](const N_Vector* v) {
        std::array<N_Vector, 2> x{v[0], v[1]}, y{v[2], v[3]}, z{v[4], v[5]};
        N_VLinearSumVectorArray(2, 0.4, x.data(), -1.1, y.data(), z.data());
        N_VScaleVectorArray(2, c.data(), y.data(), y.data());
        N_VConstVectorArray(1, 0.75, x.data());
      },
      "vector arrays");
  expect_same(
      [&](const N_Vector* v) {
        std::array<N_Vector, 2> x{v[0], v[1]}, y0{v[2], v[3]}, y1{v[4], v[5]};
        std::array<N_Vector*, 2> Y{y0.data(), y1.data()};
        N_VScaleAddMultiVectorArray(2, 2, c.data(), x.data(), Y.data(), Y.data());
        N_VLinearCombinationVectorArray(2, 2, c.data(), Y.data(), x.data());
      },
      "arrays of arrays");
  for (int j = 0; j < 2; ++j)
    expect_same_value(
        [j](N_Vector* v) {
          std::array<double, 2> dots{}, norms{};
          std::array<N_Vector, 2> y{v[1], v[2]}, w{v[3], v[4]};
          N_VDotProdMulti(2, v[0], y.data(), dots.data());
          N_VWrmsNormVectorArray(2, y.data(), w.data(), norms.data());
          return dots[j] + norms[j];
        },
        "dotprodmulti, wrmsnormvectorarray");
}

TEST_P(VectorOps, ClonesInheritTheOperations) {
  const VectorPtr clone(N_VClone(own_[0].get()));
  EXPECT_EQ(clone->ops->nvlinearsum, own_[0]->ops->nvlinearsum);
  EXPECT_NE(clone->ops->nvlinearsum, library_[0]->ops->nvlinearsum);
  EXPECT_EQ(clone->ops->nvwrmsnorm, own_[0]->ops->nvwrmsnorm);
  EXPECT_EQ(clone->ops->nvscaleaddmulti, own_[0]->ops->nvscaleaddmulti);
}

INSTANTIATE_TEST_SUITE_P(Lengths, VectorOps, ::testing::Values(1, 3, 4, 7, 15, 160));

TEST(VectorOpsOrder, SumsDoNotDependOnTheAddress) {
  const auto context = make_context();
  const int n = 37;
  std::vector<double> values(n);
  std::mt19937_64 random(3);
  std::normal_distribution<double> number;
  for (auto& v : values) v = number(random);
  const VectorPtr v = make_vector(n, context.get());
  std::copy(values.begin(), values.end(), NV_DATA_S(v.get()));
  const double reference = N_VDotProd(v.get(), v.get());
  std::vector<double> memory(n + 8);
  for (int shift = 0; shift < 8; ++shift) {
    std::copy(values.begin(), values.end(), memory.begin() + shift);
    double* own = NV_DATA_S(v.get());
    NV_DATA_S(v.get()) = memory.data() + shift;
    EXPECT_EQ(N_VDotProd(v.get(), v.get()), reference) << shift;
    NV_DATA_S(v.get()) = own;
  }
}

}  // namespace
}  // namespace drift::detail::vector_ops_test
