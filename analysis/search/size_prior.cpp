#include "analysis/search/size_prior.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "analysis/inference/thresholds.hpp"
#include "core/base/decompose.hpp"

namespace drift::search {
namespace {

constexpr std::array scales{1.0, 0.3, 0.1, 0.03, 0.01};  // of the prior's sigma
constexpr double beyond = inference::FitLimits::beyond_prior;

/// log of the sum of exp.
double log_sum_exp(const std::vector<double>& logs) {
  const double top = *std::max_element(logs.begin(), logs.end());
  double sum = 0.0;
  for (const double l : logs) sum += std::exp(l - top);
  return top + std::log(sum);
}
/// log of the mean of exp.
double log_mean_exp(const std::vector<double>& logs) {
  return log_sum_exp(logs) - std::log(static_cast<double>(logs.size()));
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
  /// The largest amplitude along an axis that shows it by itself, in prior sigmas.
  double farthest() const {
    double far = 0.0;
    for (Eigen::Index k = 0; k < y_.size(); ++k)
      if (y_[k] * y_[k] > beyond * beyond * information_[k])
        far = std::max(far, std::abs(y_[k]) / information_[k]);
    return far;
  }
  /// Log evidence of amplitudes of s prior sigmas against none.
  double log_evidence(double s) const {
    double sum = 0.0;
    for (Eigen::Index k = 0; k < y_.size(); ++k) {
      const double grown = 1.0 + s * s * information_[k];
      sum += 0.5 * (s * s * y_[k] * y_[k] / grown - std::log(grown));
    }
    return sum;
  }

 private:
  VecX information_, y_;
};

}  // namespace

double share_of_sizes(double w) {
  return std::erfc(beyond / std::numbers::sqrt2) * (beyond / w) * (beyond / w);
}

double log_evidence_of_sizes(const MatX& C, const VecX& g) {
  if (g.size() == 0) return 0.0;
  const Rotated r(C, g);
  std::vector<double> logs;
  for (const double s : scales) logs.push_back(r.log_evidence(s));
  const double usual = log_mean_exp(logs), far = r.farthest();
  if (far <= beyond) return usual;
  return log_sum_exp({usual, r.log_evidence(far) + std::log(share_of_sizes(far))});
}

VisibleEvidence evidence_of_visible_sizes(const MatX& C, const VecX& g) {
  VisibleEvidence out;
  if (g.size() == 0) return out;
  const Rotated r(C, g);
  std::vector<double> logs;
  for (const double s : scales)
    if (s * std::sqrt(r.most()) >= inference::VisibleLimits::size)
      logs.push_back(r.log_evidence(s));
  out.share = static_cast<double>(logs.size()) / static_cast<double>(std::size(scales));
  if (!logs.empty()) out.log = log_mean_exp(logs);
  return out;
}

double log_gain_of_sizes(const VecX& x, const MatX& covariance, const std::vector<int>& cause,
                         const VecX& wide) {
  if (x.size() == 0) return 0.0;
  const MatX information = covariance.inverse();
  const VecX pull = information * x;
  const double unit = log_det(information);
  const auto causes = static_cast<std::size_t>(*std::ranges::max_element(cause)) + 1;
  const auto cause_of = [&](Eigen::Index k) {
    return static_cast<std::size_t>(cause[static_cast<std::size_t>(k)]);
  };
  const auto width = [&](Eigen::Index k) { return wide.size() > 0 ? wide[k] : 1.0; };
  std::vector<double> widest(causes, 1.0);  // of the amplitudes of each
  for (Eigen::Index k = 0; k < x.size(); ++k)
    widest[cause_of(k)] = std::max(widest[cause_of(k)], width(k));
  std::vector<std::size_t> chosen(causes, 0);  // of the scales, or one more: the wide prior itself
  std::vector<double> logs;
  for (;;) {
    MatX A = information;
    double weight = 0.0;  // log of the share, and of the priors' densities at zero
    for (std::size_t c = 0; c < causes; ++c)
      weight += std::log(chosen[c] == scales.size() ? share_of_sizes(widest[c])
                                                    : 1.0 / static_cast<double>(scales.size()));
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      const std::size_t c = chosen[cause_of(k)];
      const double s = c == scales.size() ? 1.0 : scales[c] / width(k);
      A(k, k) += 1.0 / (s * s) - 1.0;
      weight -= std::log(s);
    }
    // Of a Gaussian with information `information` about x, times the ratio of the priors.
    logs.push_back(weight + 0.5 * (unit - log_det(A)) +
                   0.5 * (pull.dot(Cholesky(A).solve(pull)) - x.dot(pull)));
    std::size_t next = 0;
    const auto last = [&](std::size_t c) { return scales.size() + (widest[c] > beyond ? 1 : 0); };
    while (next < causes && ++chosen[next] == last(next)) chosen[next++] = 0;
    if (next == causes) break;
  }
  return log_sum_exp(logs);
}

}  // namespace drift::search
