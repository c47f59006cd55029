#include "analysis/strapdown/where.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace drift::strapdown {
namespace {

using diagnosis::Diagnosis;
using diagnosis::RecoveredSignal;
using diagnosis::Share;

double square_or_zero(double v) {
  return std::isfinite(v) ? v * v : 0.0;
}

/// Part of the sum of squares that falls on some cells; its sigma as if the cells were drawn anew.
Share share_of(std::span<const double> squares, double total) {
  Share s;
  double sum = 0.0, fourth = 0.0;
  std::size_t n = 0;
  for (const double q : squares) {
    sum += q;
    fourth += q * q;
    n += q > 0.0 ? 1 : 0;
  }
  s.share = total > 0.0 ? sum / total : 0.0;
  s.sigma = total > 0.0 ? std::sqrt(fourth) / total : 0.0;
  s.chi2_per_dof = n > 0 ? sum / static_cast<double>(n) : 0.0;
  s.z = n > 0 ? (s.chi2_per_dof - 1.0) / std::sqrt(2.0 / static_cast<double>(n)) : 0.0;
  return s;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double n = static_cast<double>(a.size());
  double ma = 0.0, mb = 0.0, ab = 0.0, aa = 0.0, bb = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    ma += a[k] / n;
    mb += b[k] / n;
  }
  for (std::size_t k = 0; k < a.size(); ++k) {
    ab += (a[k] - ma) * (b[k] - mb);
    aa += (a[k] - ma) * (a[k] - ma);
    bb += (b[k] - mb) * (b[k] - mb);
  }
  return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : 0.0;
}

RecoveredSignal signal_of(int gyro, const Residuals& before, const Residuals& after, double scatter,
                          const Evidence& evidence,
                          const std::array<std::vector<double>, 3>& force) {
  RecoveredSignal s;
  s.equation = fmt::format("gyro rate {}", "xyz"[gyro]);
  s.unit = "deg/s";
  for (std::size_t k = 0; k < evidence.dwells.size(); ++k) {
    const Dwell& dwell = evidence.dwells[k];
    const auto column = static_cast<Eigen::Index>(k);
    s.t.push_back(0.5 * (dwell.start + dwell.end));
    s.position.push_back(static_cast<int>(k) + 1);
    s.value.push_back(before(gyro, column) / unit::deg_per_s.to_si);
    s.sigma.push_back(scatter / unit::deg_per_s.to_si);
    s.explained.push_back((before(gyro, column) - after(gyro, column)) / unit::deg_per_s.to_si);
  }
  for (int axis = 0; axis < 3; ++axis)
    if (const double r = correlation(s.value, force[axis]); std::abs(r) > std::abs(s.correlation)) {
      s.correlation = r;
      s.shape.covariate = fmt::format("acc_{}", "xyz"[axis]);
    }
  if (const double r = correlation(s.value, s.t); std::abs(r) > std::abs(s.correlation)) {
    s.correlation = r;
    s.shape.covariate = "time";
  }
  // Of n independent pairs |r| exceeds 2 / sqrt(n) in one case of twenty; four are tried.
  const bool follows = std::abs(s.correlation) > 3.0 / std::sqrt(static_cast<double>(s.t.size()));
  s.shape.kind =
      follows ? diagnosis::Shape::Kind::follows : diagnosis::Shape::Kind::follows_nothing;
  return s;
}

}  // namespace

void fill_where(const Residuals& before, const Residuals& after,
                const Eigen::Vector<double, 5>& scatter, const Evidence& evidence,
                const Theta& theta, Diagnosis& d) {
  const Eigen::Index n = before.cols();
  const Eigen::Matrix<double, 5, Eigen::Dynamic> scaled =
      scatter.cwiseInverse().asDiagonal() * before;
  const Eigen::Matrix<double, 5, Eigen::Dynamic> rest = scatter.cwiseInverse().asDiagonal() * after;
  const MatX squares = scaled.unaryExpr(&square_or_zero);
  const double total = squares.sum();
  auto& where = d.where;
  where.channel_names = residual_names;
  for (int c = 0; c < 5; ++c) {
    const VecX row = squares.row(c);
    Share s = share_of({row.data(), static_cast<std::size_t>(n)}, total);
    s.name = residual_names[static_cast<std::size_t>(c)];
    where.channels.push_back(s);
  }
  for (Eigen::Index k = 0; k < n; ++k) {
    const VecX column = squares.col(k);
    Share s = share_of({column.data(), 5}, total);
    s.position = static_cast<int>(k) + 1;
    where.positions.push_back(s);
    for (int c = 0; c < 5; ++c)
      where.heat.push_back(
          {s.position, c, total > 0.0 ? squares(c, k) / total : 0.0, squares(c, k)});
  }
  for (auto* list : {&where.channels, &where.positions})
    std::ranges::stable_sort(*list, std::greater{}, &Share::share);
  const std::string& first = where.channels.front().name;
  if (d.has_patch)
    where.equation = first == "turn"  ? "case rate while turning"
                     : first == "acc" ? "accelerometers"
                                      : fmt::format("gyro rate {} in dwells", first.back());

  auto& fit = d.fit;
  fit.residual_before.setConstant(6, n, std::nan(""));
  fit.residual_before.topRows<5>() = scaled;
  fit.residual_after = fit.residual_before;
  fit.residual_after.topRows<5>() = rest;
  fit.dof = static_cast<std::size_t>((scaled.array().isFinite()).count());
  fit.chi2_before = total;
  fit.chi2_after = rest.unaryExpr(&square_or_zero).sum();
  fit.chi2_per_dof_before = fit.chi2_before / static_cast<double>(fit.dof);
  fit.chi2_per_dof_after = fit.chi2_after / static_cast<double>(fit.dof);
  // No likelihood without declared noise, no scan of windows.
  where.scan_p_value = fit.band_low = fit.band_high = fit.log_likelihood_ratio = fit.linear_T =
      std::nan("");
  fit.whiteness = {std::nan(""), std::nan(""), std::nan(""), std::nan("")};
  fit.start_spread_before = fit.start_spread_after = std::nan("");

  const SpecificForce force(theta);
  std::array<std::vector<double>, 3> f;
  for (const Dwell& dwell : evidence.dwells) {
    fit.residual_t.push_back(0.5 * (dwell.start + dwell.end));
    const Vec3 up = force(dwell.acc);
    for (int axis = 0; axis < 3; ++axis) f[static_cast<std::size_t>(axis)].push_back(up[axis]);
  }
  for (int gyro = 0; gyro < 3; ++gyro)
    d.signals.push_back(signal_of(gyro, before, after, scatter[gyro], evidence, f));
  std::ranges::stable_sort(d.signals, std::greater{}, [](const RecoveredSignal& s) {
    double sum = 0.0;
    for (const double v : s.value) sum += v * v;
    return sum;
  });
}

}  // namespace drift::strapdown
