#include "analysis/observability/ranking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/decompose.hpp"

namespace drift::observability {
namespace {

constexpr double wide_attitude = 1e-4;  // weight of an attitude prior that says nothing

}  // namespace

double ParameterRank::bits() const {
  return -std::log2(learning_ratio());
}

std::vector<EigenDirection> spectrum_of(const MatX& information_root) {
  const RightSingular svd = right_singular(information_root);
  std::vector<EigenDirection> all;
  for (Eigen::Index i = 0; i < information_root.cols(); ++i) {
    EigenDirection d{std::pow(svd.values[i], 2), svd.vectors.col(i), {}};
    std::vector<std::size_t> states(static_cast<std::size_t>(d.direction.size()));
    std::iota(states.begin(), states.end(), std::size_t{0});
    std::ranges::stable_sort(states, std::greater{},
                             [&](std::size_t k) { return d.participation(k); });
    double part = 0.0;
    for (const std::size_t k : states) {
      if (part >= 0.8 || d.dominant.size() == 4) break;
      d.dominant.push_back(k);
      part += d.participation(k);
    }
    all.push_back(std::move(d));
  }
  return all;
}

Ranking rank_parameters(const LinearisedPlan& plan) {
  const MatX root = whole_root(plan);
  const Posterior posterior = posterior_of(root, plan.bins.back().walked);
  Ranking out;
  out.layout = plan.layout;
  out.walking = plan.bins.back().walked.states;
  out.bits = posterior.bits;
  out.covariance = posterior.covariance();
  for (Eigen::Index k = 0; k < plan.size(); ++k) {
    const double prior = plan.layout.sigma[k];
    ParameterRank p;
    p.param = plan.layout.params[k];
    p.prior_sigma = prior;
    p.posterior_sigma = prior * posterior.sigma[k];
    p.conditional_sigma = prior * posterior.conditional[k];
    p.partner = static_cast<std::size_t>(k);
    for (Eigen::Index j = 0; j < plan.size(); ++j) {
      const double rho = out.covariance(k, j) / (posterior.sigma[k] * posterior.sigma[j]);
      if (j == k || !(std::abs(rho) > std::abs(p.correlation))) continue;
      p.partner = static_cast<std::size_t>(j);
      p.correlation = rho;
    }
    out.parameters.push_back(p);
  }
  out.order.resize(out.parameters.size());
  std::iota(out.order.begin(), out.order.end(), std::size_t{0});
  std::ranges::stable_sort(out.order, {}, [&](std::size_t k) { return out.learning_ratio(k); });
  out.spectrum = spectrum_of(root);
  for (auto d = out.spectrum.rbegin(); d != out.spectrum.rend(); ++d)
    if (d->information < unseen_information) out.unseen.push_back({d->information, d->direction});
  out.root = root;
  out.root_unheld = whole_root(plan, wide_attitude);
  out.unheld = weak_directions(out.root_unheld, unseen_information);
  out.excitation = plan.excitation;
  return out;
}

std::string name_of(const EigenDirection& direction, const Layout& layout) {
  std::string text;
  for (const std::size_t k : direction.dominant)
    text += fmt::format(
        "{}{}{} ({:.0f} %)", text.empty() ? "" : ", ", direction.direction[k] < 0.0 ? "-" : "+",
        TermLibrary::specs[layout.params[k]].key.view(), 100.0 * direction.participation(k));
  return text;
}

}  // namespace drift::observability
