#include "analysis/inference/max_t.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "analysis/inference/thresholds.hpp"
#include "core/base/decompose.hpp"
#include "core/base/normal_draws.hpp"

namespace drift::inference {
namespace {

constexpr std::uint64_t null_seed =
    20230517;  // any number: fixed, so that a diagnosis is repeatable

}  // namespace

double Contrast::T(const VecX& g) const {
  if (dof == 0) return 0.0;
  return (W.transpose() * g(columns)).squaredNorm();
}

Contrast make_contrast(const MatX& C, const VecX& raw, const std::vector<int>& columns) {
  Contrast out{columns, {}, 0};
  const Eigensystem eigen = eigensystem(C(columns, columns));
  const double largest_raw = columns.empty() ? 0.0 : raw(columns).maxCoeff();
  const double least = std::max(VisibleLimits::information, 1e-9 * largest_raw);
  std::vector<Eigen::Index> keep;
  for (Eigen::Index k = 0; k < eigen.values.size(); ++k)
    if (eigen.values[k] > least) keep.push_back(k);
  out.dof = static_cast<int>(keep.size());
  out.W.resize(columns.size(), out.dof);
  for (int k = 0; k < out.dof; ++k)
    out.W.col(k) = eigen.vectors.col(keep[k]) / std::sqrt(eigen.values[keep[k]]);
  return out;
}

MaxNull::MaxNull(const MatX& C, const std::vector<Contrast>& contrasts, int draws,
                 std::uint64_t stream) {
  // Only columns that some contrast uses.
  std::vector<int> used;
  for (const Contrast& c : contrasts)
    if (c.dof > 0) used.insert(used.end(), c.columns.begin(), c.columns.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  if (used.empty()) return;
  const MatX g = draw(C(used, used), draws, stream);

  std::map<int, VecX> largest;  // by degrees of freedom
  for (const Contrast& c : contrasts) {
    if (c.dof == 0) continue;
    MatX part(draws, c.columns.size());
    for (std::size_t k = 0; k < c.columns.size(); ++k)
      part.col(k) = g.col(std::lower_bound(used.begin(), used.end(), c.columns[k]) - used.begin());
    const VecX T = (part * c.W).rowwise().squaredNorm();
    auto [place, fresh] = largest.try_emplace(c.dof, T);
    if (!fresh) place->second = place->second.cwiseMax(T);
  }
  maxima_.assign(draws, 0.0);
  for (const auto& [dof, T] : largest)
    for (int k = 0; k < draws; ++k) maxima_[k] = std::max(maxima_[k], stats::strength(T[k], dof));
  std::sort(maxima_.begin(), maxima_.end());
  calibrate();
}

MatX MaxNull::draw(const MatX& C, int draws, std::uint64_t stream) {
  if (C.rows() == 0) return MatX::Zero(draws, 0);  // nothing shows on this plan
  const Eigensystem eigen = eigensystem(C);
  // Of many effects at many settings half the directions carry nothing but rounding.
  const double rounding = static_cast<double>(C.rows()) * std::numeric_limits<double>::epsilon() *
                          eigen.values.tail<1>()[0];
  const Eigen::Index seen = (eigen.values.array() > rounding).count();
  const MatX root =
      eigen.vectors.rightCols(seen) * eigen.values.tail(seen).cwiseSqrt().asDiagonal();
  MatX z(draws, seen);
  NormalDraws normal(null_seed, stream);
  for (Eigen::Index k = 0; k < z.size(); ++k) z.data()[k] = normal();
  return z * root.transpose();
}

MaxNull MaxNull::of(const VecX& maxima) {
  MaxNull n;
  n.maxima_.assign(maxima.begin(), maxima.end());
  std::sort(n.maxima_.begin(), n.maxima_.end());
  n.calibrate();
  return n;
}

MaxNull MaxNull::joined(const std::vector<MaxNull>& families) {
  MaxNull all;
  for (const MaxNull& f : families)
    if (!f.maxima_.empty()) all.parts_.push_back(f.maxima_);
  all.calibrate();
  return all;
}

double MaxNull::single_p(const std::vector<double>& maxima, double strength) const {
  const auto above = maxima.end() - std::lower_bound(maxima.begin(), maxima.end(), strength);
  return static_cast<double>(above) / static_cast<double>(maxima.size());
}

void MaxNull::calibrate() {
  if (maxima_.empty() && parts_.empty()) return;
  // Tail: p_fw = tests * p. A hundred draws of each family lie above where the count is made.
  if (parts_.empty()) {
    const std::size_t place = maxima_.size() - std::max<std::size_t>(1, maxima_.size() / 40);
    const double p = single_p(maxima_, maxima_[place]);
    log_tests_ = std::log(p) + maxima_[place];
    return;
  }
  double tests = 0.0;
  for (const auto& part : parts_) {
    const std::size_t place = part.size() - std::max<std::size_t>(1, part.size() / 40);
    tests += single_p(part, part[place]) * std::exp(part[place]);
  }
  log_tests_ = std::log(tests);
}

double MaxNull::log_p(double s) const {
  if (maxima_.empty() && parts_.empty()) return 0.0;
  const double tail = log_tests_ - s;
  double quiet = 0.0;  // log of the probability that all are quiet
  if (parts_.empty()) {
    const double p = single_p(maxima_, s);
    if (p >= 0.025) return std::log(p);
  } else {
    bool reached = false;
    for (const auto& part : parts_) {
      const double p = single_p(part, s);
      reached = reached || p >= 0.025;
      quiet += std::log1p(-std::min(p, 1.0 - 1e-12));
    }
    if (reached) return std::log(-std::expm1(quiet));
  }
  return std::min(tail, std::log(-std::expm1(-std::exp(std::min(tail, 3.0)))));
}

double MaxNull::p_value(double s) const {
  return std::exp(log_p(s));
}

double MaxNull::threshold(double alpha) const {
  if (maxima_.empty() && parts_.empty()) return 0.0;
  double low = 0.0, high = 200.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (p_value(middle) > alpha ? low : high) = middle;
  }
  return high;
}

}  // namespace drift::inference
