#include "analysis/blind/nearest.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/blind/library_effects.hpp"
#include "analysis/inference/candidate.hpp"
#include "core/base/decompose.hpp"

namespace drift::blind {
namespace {

using inference::Settings;

/// One parameter of a term at one prior sigma, times the strength; settings of one known value,
/// which no grid has, at that.
Source one_parameter(const TermInfo& term, std::size_t param, const Settings& settings) {
  Source s;
  s.put = [=](World& w, double strength) {
    for (std::size_t i = term.first; i < term.first + term.count; ++i) {
      if (TermLibrary::specs[i].amplitude() || w.truth.active[i]) continue;
      w.truth.active.set(i);
      w.draw.theta[i] = TermLibrary::specs[i].prior_si().mean();
    }
    w.truth.active.set(param);
    w.draw.theta[param] += strength * TermLibrary::specs[param].prior_si().sigma();
    for (const auto& [i, value] : settings) {
      w.truth.active.set(i);
      w.draw.theta[i] = value;
    }
  };
  return s;
}

/// Cosine between the last column's signal and the best mixture of the others.
double mixture_cosine(const MatX& products) {
  const Eigen::Index n = products.rows() - 1;
  const double whole = products(n, n);
  // Signals that leave next to nothing are no likeness.
  std::vector<Eigen::Index> seen;
  for (Eigen::Index k = 0; k < n; ++k)
    if (products(k, k) > 1e-9 * products.diagonal().maxCoeff()) seen.push_back(k);
  if (seen.empty() || whole <= 0.0) return 0.0;
  const VecX scale = products.diagonal()(seen).cwiseSqrt().cwiseInverse();
  const MatX G = scale.asDiagonal() * MatX(products(seen, seen)) * scale.asDiagonal();
  const VecX b = scale.cwiseProduct(VecX(products(seen, n)));
  const MatX regular = G + 1e-9 * MatX::Identity(G.rows(), G.cols());
  return std::sqrt(std::clamp(b.dot(solve_symmetric(regular, b)) / whole, 0.0, 1.0));
}

}  // namespace

Nearest nearest_in_library(const SizingBench& bench, const FilterSpec& nominal,
                           const VecX& signal) {
  constexpr double strength = 0.3;  // prior sigmas: nearly linear
  Nearest best;
  const Timeline& timeline = bench.world().timeline;
  for (const std::size_t t : hideable_terms(nominal, timeline)) {
    const TermInfo& term = TermLibrary::terms[t];
    if (term.key == closure_term || !timeline.carries(term.needs)) continue;
    std::map<std::string, std::vector<std::size_t>> axes;
    for (const std::size_t i : missing_parameters(term, nominal))
      axes[std::string(TermLibrary::specs[i].axis)].push_back(i);
    for (const Settings& settings : inference::settings_of(term, nominal.active, timeline))
      for (const auto& [axis, params] : axes) {
        MatX signals(signal.size(), static_cast<Eigen::Index>(params.size()) + 1);
        for (std::size_t k = 0; k < params.size(); ++k)
          signals.col(static_cast<Eigen::Index>(k)) =
              bench.signal(one_parameter(term, params[k], settings), strength);
        signals.rightCols<1>() = signal;
        const double cosine = mixture_cosine(bench.absorption().left_products(signals));
        if (cosine > best.cosine) best = {std::string(term.key), axis, cosine};
      }
  }
  return best;
}

}  // namespace drift::blind
