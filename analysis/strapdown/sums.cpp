#include "analysis/strapdown/sums.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/decompose.hpp"

namespace drift::strapdown {
namespace {

constexpr double small_part = 0.02, about_one = 0.02;

/// What a member is multiplied with, beside a number, to be in the unit of the sum: "g" turns
/// deg/h/g into deg/h; of units that have nothing in common "(ug per arcsec)".
std::string unit_of_factor(std::string_view member, std::string_view sum) {
  if (member == sum) return "";
  if (member.starts_with(sum) && member.substr(sum.size()).starts_with('/')) {
    std::string rest(member.substr(sum.size() + 1));
    if (rest.find('/') == std::string::npos) return rest;
  }
  if (sum.starts_with(member) && sum.substr(member.size()).starts_with('/'))
    return "1" + std::string(sum.substr(member.size()));
  return fmt::format("({} per {})", sum, member);
}

/// "+ 0.52 g D_I_z", the first without a plus.
std::string member(double factor, std::string_view key, const std::string& unit, bool first) {
  const double size = std::abs(factor);
  const bool plain = std::abs(size - 1.0) < about_one && unit.empty();
  const std::string number =
      plain ? "" : fmt::format("{:.2g} {}{}", size, unit, unit.empty() ? "" : " ");
  return fmt::format("{}{}{}", first ? (factor < 0.0 ? "-" : "") : (factor < 0.0 ? " - " : " + "),
                     number, key);
}

/// Rows that span the same directions, each with a one where the others have a zero: sums of as few
/// members as there are.
MatX reduced(MatX rows) {
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    Eigen::Index pivot = 0, column = 0;
    rows.bottomRows(rows.rows() - r).cwiseAbs().maxCoeff(&pivot, &column);
    rows.row(r).swap(rows.row(r + pivot));
    rows.row(r) /= rows(r, column);
    for (Eigen::Index other = 0; other < rows.rows(); ++other)
      if (other != r) rows.row(other) -= (rows(other, column) * rows.row(r)).eval();
  }
  return rows;
}

}  // namespace

std::vector<StrapdownParameter> known_sums(const EstimateResult& estimate) {
  std::vector<Eigen::Index> unknown;
  for (std::size_t k = 0; k < estimate.parameters.size(); ++k)
    if (estimate.parameters[k].learning_ratio() > learned_ratio)
      unknown.push_back(static_cast<Eigen::Index>(k));
  if (unknown.empty()) return {};
  const MatX P = estimate.covariance(unknown, unknown);
  const Eigensystem eigen = eigensystem(P);
  const auto known = static_cast<Eigen::Index>(std::ranges::count_if(
      eigen.values, [](double v) { return std::sqrt(std::max(v, 0.0)) < learned_ratio; }));
  // Below the rounding nothing is known: it is a convention, such as that drifts with the input
  // axis have no common part where nothing shows it.
  const double rounding = static_cast<double>(unknown.size()) *
                          std::numeric_limits<double>::epsilon() * eigen.values.maxCoeff();
  const auto agreed = static_cast<Eigen::Index>(
      std::ranges::count_if(eigen.values, [&](double v) { return v < rounding; }));
  if (known <= agreed) return {};
  // Smallest come first.
  const MatX sums = reduced(eigen.vectors.middleCols(agreed, known - agreed).transpose());
  std::vector<StrapdownParameter> all;
  for (Eigen::Index d = 0; d < sums.rows(); ++d) {
    const VecX direction = sums.row(d);
    Eigen::Index largest = 0;
    direction.cwiseAbs().maxCoeff(&largest);
    const auto of = [&](Eigen::Index k) -> const ParameterEstimate& {
      return estimate.parameters[static_cast<std::size_t>(unknown[static_cast<std::size_t>(k)])];
    };
    const ParamSpec& spec = TermLibrary::specs[of(largest).param];
    StrapdownParameter sum{"", 0.0, 0.0, std::string(spec.unit.symbol.view()),
                           "a sum: its members are not told apart"};
    VecX kept = VecX::Zero(direction.size());
    for (const bool first : {true, false})
      for (Eigen::Index k = 0; k < direction.size(); ++k) {
        const double part = direction[k] / direction[largest];
        if ((k == largest) != first || std::abs(part) < small_part) continue;
        const ParameterEstimate& p = of(k);
        const ParamSpec& own = TermLibrary::specs[p.param];
        kept[k] = part;
        // In the member's own unit, so that the sum is in that of the largest.
        const double factor =
            part * of(largest).prior_sigma / p.prior_sigma * own.unit.to_si / spec.unit.to_si;
        sum.key += member(factor, own.key.view(),
                          unit_of_factor(own.unit.symbol.view(), spec.unit.symbol.view()),
                          sum.key.empty());
        sum.value += part * of(largest).prior_sigma * p.value / p.prior_sigma;
      }
    sum.value /= spec.unit.to_si;
    sum.sigma = of(largest).prior_sigma * std::sqrt(kept.dot(P * kept)) / spec.unit.to_si;
    all.push_back(std::move(sum));
  }
  return all;
}

}  // namespace drift::strapdown
