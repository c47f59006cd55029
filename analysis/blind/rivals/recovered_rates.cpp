#include "analysis/blind/rivals/recovered_rates.hpp"

#include <cmath>
#include <set>

#include "core/base/decompose.hpp"

namespace drift::blind {

RateRegression rate_regression(const RivalTest& test) {
  std::vector<int> columns;
  for (const RivalTest::Column& c : test.columns) columns.push_back(c.column);
  const auto K = static_cast<Eigen::Index>(columns.size());
  RateRegression out{MatX::Zero(K, K), VecX::Zero(K), 0.0, 0.0, {}};
  for (const diagnosis::InputEstimate& input : test.inputs) {
    if (input.equation != inference::Equation::rate || !(input.gain > 0.0)) continue;
    const VecX weight = input.sigma.cwiseMax(1e-300).cwiseInverse();
    const VecX y = input.value.cwiseProduct(weight);
    const MatX X = weight.asDiagonal() * (input.smoother * input.cross(Eigen::all, columns));
    out.gram += X.transpose() * X;
    out.product += X.transpose() * y;
    out.square += y.squaredNorm();
    out.count += static_cast<double>(y.size());
  }
  const VecX scale = out.gram.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  out.gram = scale.asDiagonal() * out.gram * scale.asDiagonal();
  out.product = out.product.cwiseProduct(scale);
  for (const RivalTest::Column& c : test.columns) out.candidate.push_back(c.candidate);
  return out;
}

double RateRegression::bic(const std::vector<int>& columns) const {
  const double price = std::log(std::max(2.0, count)) * static_cast<double>(columns.size());
  if (columns.empty()) return square;
  MatX G = gram(columns, columns);
  G.diagonal().array() += 1e-9;  // columns that are alike
  const VecX b = product(columns);
  return square - b.dot(Cholesky(G).solve(b)) + price;
}

RivalAnswer answer_of(const RateRegression& regression, const std::vector<int>& columns) {
  std::set<std::size_t> named;
  for (const int c : columns) named.insert(regression.candidate[static_cast<std::size_t>(c)]);
  return {!named.empty(), {named.begin(), named.end()}};
}

}  // namespace drift::blind
