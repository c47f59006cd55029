#include "analysis/inference/size_prior.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "analysis/inference/thresholds.hpp"
#include "core/base/decompose.hpp"
#include "core/stats/normal.hpp"

namespace drift::inference {
namespace {

constexpr std::array scales{1.0, 0.3, 0.1, 0.03, 0.01};  // of the prior's sigma
constexpr double beyond = FitLimits::beyond_prior;

/// log of the mean of exp.
double log_mean_exp(const std::vector<double>& logs) {
  const double top = *std::max_element(logs.begin(), logs.end());
  double sum = 0.0;
  for (const double l : logs) sum += std::exp(l - top);
  return top + std::log(sum / static_cast<double>(logs.size()));
}

double log_det(const MatX& A) {
  const MatX L = Cholesky(A).L();
  return 2.0 * L.diagonal().array().log().sum();
}

/// Information and gradient along the axes in which the amplitudes do not meet.
class Rotated {
 public:
  Rotated(const MatX& C, const VecX& g) {
    const Eigensystem eigen = eigensystem(C);
    information_ = eigen.values.cwiseMax(0.0);
    y_ = eigen.vectors.transpose() * g;
  }
  double most() const { return information_.maxCoeff(); }
  /// Log evidence of amplitudes of s prior sigmas against none.
  double log_evidence(double s) const {
    double sum = 0.0;
    for (Eigen::Index k = 0; k < y_.size(); ++k) sum += log_evidence(k, s);
    return sum;
  }
  /// The same where those that a normal prior does not explain are as far off as they are found;
  /// -infinity if it explains all.
  double log_evidence_as_found() const {
    std::vector<double> logs(scales.size(), 0.0);
    double far = 0.0;
    bool any = false;
    for (Eigen::Index k = 0; k < y_.size(); ++k) {
      const double I = information_[k], sigmas = std::abs(y_[k]) / I;
      const bool explained = y_[k] * y_[k] <= beyond * beyond * (I * I + I);
      if (!explained) far += log_evidence(k, sigmas) + std::log(share_of_sizes(sigmas));
      for (std::size_t s = 0; s < scales.size() && explained; ++s)
        logs[s] += log_evidence(k, scales[s]);
      any = any || !explained;
    }
    return any ? far + log_mean_exp(logs) : -std::numeric_limits<double>::infinity();
  }

 private:
  double log_evidence(Eigen::Index k, double s) const {
    const double grown = 1.0 + s * s * information_[k];
    return 0.5 * (s * s * y_[k] * y_[k] / grown - std::log(grown));
  }

  VecX information_, y_;
};

double log_gain(const VecX& x, const MatX& covariance, const std::vector<int>& cause,
                const std::vector<double>& wide, std::span<const double> of_prior) {
  if (x.size() == 0) return 0.0;
  const MatX information = covariance.inverse();
  const VecX pull = information * x;
  const double unit = log_det(information);
  const int causes = *std::max_element(cause.begin(), cause.end()) + 1;
  const auto width = [&](std::size_t k) { return wide.empty() ? 1.0 : wide[k]; };
  double far = 0.0;  // log of the shares of sizes as they are found
  for (const double w : wide)
    if (w > beyond) far += std::log(share_of_sizes(w));
  std::vector<std::size_t> chosen(static_cast<std::size_t>(causes), 0);
  std::vector<double> logs;
  for (;;) {
    MatX A = information;
    double shrunk = 0.0;  // log of the priors' densities at zero, over the unit prior's
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      const auto amplitude = static_cast<std::size_t>(k);
      if (width(amplitude) > beyond) continue;
      const double s =
          of_prior[chosen[static_cast<std::size_t>(cause[amplitude])]] / width(amplitude);
      A(k, k) += 1.0 / (s * s) - 1.0;
      shrunk -= std::log(s);
    }
    // Of a Gaussian with information `information` about x, times the ratio of the priors.
    logs.push_back(shrunk + 0.5 * (unit - log_det(A)) +
                   0.5 * (pull.dot(Cholesky(A).solve(pull)) - x.dot(pull)));
    std::size_t next = 0;
    while (next < chosen.size() && ++chosen[next] == of_prior.size()) chosen[next++] = 0;
    if (next == chosen.size()) return log_mean_exp(logs) + far;
  }
}

}  // namespace

double share_of_sizes(double w) {
  return std::erfc(beyond / std::numbers::sqrt2) * (beyond / w) * (beyond / w);
}

DataAlone without_prior(double off, double sigma, double prior_sigma) {
  const double told = 1.0 - std::pow(sigma / prior_sigma, 2);  // of the prior's variance
  return {off / told, off / (prior_sigma * std::sqrt(told))};
}

double log_evidence_of_sizes(const MatX& C, const VecX& g) {
  if (g.size() == 0) return 0.0;
  const Rotated r(C, g);
  std::vector<double> logs;
  for (const double s : scales) logs.push_back(r.log_evidence(s));
  const double usual = log_mean_exp(logs), as_found = r.log_evidence_as_found();
  const double top = std::max(usual, as_found), other = std::min(usual, as_found);
  return std::isinf(other) ? top : top + std::log1p(std::exp(other - top));
}

VisibleEvidence evidence_of_visible_sizes(const MatX& C, const VecX& g) {
  VisibleEvidence out;
  if (g.size() == 0) return out;
  const Rotated r(C, g);
  std::vector<double> logs;
  for (const double s : scales)
    if (s * std::sqrt(r.most()) >= VisibleLimits::size) logs.push_back(r.log_evidence(s));
  out.share = static_cast<double>(logs.size()) / static_cast<double>(std::size(scales));
  if (!logs.empty()) out.log = log_mean_exp(logs);
  return out;
}

double log_gain_of_sizes(const VecX& x, const MatX& covariance, const std::vector<int>& cause,
                         const std::vector<double>& wide) {
  return log_gain(x, covariance, cause, wide, scales);
}

double log_gain_of_sizes_made_small(const VecX& x, const MatX& covariance) {
  if (x.size() == 0) return 0.0;
  const double unseen = std::sqrt(eigensystem(covariance).values.minCoeff()) / 3.0;
  std::vector<double> finer(scales.begin(), scales.end());
  while (finer.back() > unseen && finer.back() > 1e-9)
    finer.push_back(finer[finer.size() - 2] / 10.0);
  return log_gain(x, covariance, std::vector<int>(static_cast<std::size_t>(x.size()), 0), {},
                  finer);
}

double log_evidence_of_unknown_size(double T, int amplitudes) {
  constexpr double smallest = VisibleLimits::size;
  const double z = std::sqrt(T), peak = std::max(z, smallest);
  const double one =
      0.5 * T + std::log(stats::normal_distribution(z - smallest) *
                         std::sqrt(2.0 * std::numbers::pi) / (2.0 * peak * std::log(100.0)));
  return amplitudes == 1 ? one : one + std::log(std::sqrt(2.0 / std::numbers::pi) / peak);
}

}  // namespace drift::inference
