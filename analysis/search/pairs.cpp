#include "analysis/search/pairs.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "analysis/inference/thresholds.hpp"
#include "core/base/decompose.hpp"
#include "core/base/rng.hpp"

namespace drift::search {
namespace {

using inference::EffortLimits;
using inference::ReachLimits;

/// A single observable column that a candidate has.
struct SingleColumn {
  Choice choice;
  int column = 0;
};

std::vector<SingleColumn> single_columns(const Field& field) {
  std::vector<SingleColumn> units;
  for (std::size_t c = 0; c < field.set.candidates.size(); ++c)
    for (std::size_t v = 0; v < field.set.candidates[c].variants.size(); ++v)
      if (field.contrasts[c][v].columns.size() == 1 && field.contrasts[c][v].dof == 1 &&
          field.discount_of(c) == 0.0)
        units.push_back({{c, v}, field.contrasts[c][v].columns[0]});
  return units;
}

/// Scores of units with unit variance.
struct UnitScores {
  MatX rho;  ///< their correlations
  VecX z;
};

UnitScores scores_of(const Field& field, const std::vector<SingleColumn>& units) {
  std::vector<int> columns;
  for (const SingleColumn& u : units) columns.push_back(u.column);
  const MatX C = field.projected.C(columns, columns);
  const VecX scale = C.diagonal().cwiseSqrt().cwiseInverse();
  return {scale.asDiagonal() * C * scale.asDiagonal(),
          field.projected.g(columns).cwiseProduct(scale)};
}

double joint(double za, double zb, double rho) {
  return (za * za + zb * zb - 2.0 * rho * za * zb) / (1.0 - rho * rho);
}

/// What a pair would be called: terms and axes.
std::string name_of(const Field& field, const Choice& one, const Choice& other) {
  const auto name = [&](const Choice& c) {
    const inference::Candidate& candidate = field.set.candidates[c.candidate];
    return candidate.term + "." + candidate.axis;
  };
  const std::string a = name(one), b = name(other);
  return a < b ? a + " " + b : b + " " + a;
}

/// Log evidence of a few columns with unit priors: what the choice among thousands of pairs needs.
double quick_log_bayes(const inference::Projected& p, const std::vector<int>& columns) {
  const VecX g = p.g(columns);
  const MatX A = p.C(columns, columns) + MatX::Identity(g.size(), g.size());
  const Cholesky root(A);
  return 0.5 * g.dot(root.solve(g)) - root.L().diagonal().array().log().sum();
}

bool same_candidate(const SingleColumn& a, const SingleColumn& b) {
  return a.choice.candidate == b.choice.candidate;
}

}  // namespace

std::vector<Pair> strongest_pairs(const Field& field, std::size_t most) {
  const auto units = single_columns(field);
  const auto [rho, z] = scores_of(field, units);
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < units.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      if (same_candidate(units[i], units[k]) || inference::same_trace(rho(i, k))) continue;
      const double T = joint(z[i], z[k], rho(i, k));
      if (pairs.size() == most && T <= pairs.back().T) continue;
      if (pairs.size() == most) pairs.pop_back();
      Pair p{units[k].choice, units[i].choice, T, 2, 0.5 * T, 0.0};
      pairs.insert(std::upper_bound(pairs.begin(), pairs.end(), p,
                                    [](const Pair& a, const Pair& b) { return a.T > b.T; }),
                   p);
    }
  for (Pair& p : pairs)
    p.log_bayes = log_bayes(field.projected, distinct_columns_of(field.set, {p.a, p.b}));
  return pairs;
}

inference::MaxNull pair_null(const Field& field, int draws) {
  const auto units = single_columns(field);
  if (units.size() < 2) return {};
  const MatX rho = scores_of(field, units).rho;
  const MatX g = inference::MaxNull::draw(rho, draws, 2);
  VecX largest = VecX::Zero(draws);
  for (std::size_t i = 0; i < units.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const double r = rho(i, k);
      if (same_candidate(units[i], units[k]) || inference::same_trace(r)) continue;
      const double w = 1.0 / (1.0 - r * r);
      for (int d = 0; d < draws; ++d) {
        const double a = g(d, i), b = g(d, k);
        largest[d] = std::max(largest[d], (a * a + b * b - 2.0 * r * a * b) * w);
      }
    }
  return inference::MaxNull::of(0.5 * largest);
}

std::vector<Pair> adequate_pairs(const Field& field, const std::vector<Score>& scores,
                                 double library_threshold, double scan_threshold, std::size_t most,
                                 const WorthALook& worth) {
  // Which candidates at which variants: all single parameters, and the strongest of the others.
  // Alone a candidate may look best at another time constant than with a partner.
  std::vector<Choice> choices;
  std::vector<std::size_t> order(scores.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return scores[a].strength > scores[b].strength;
  });
  std::size_t several = 0;
  for (const std::size_t k : order) {
    if (scores[k].dof == 0) continue;
    const inference::Candidate& c = field.set.candidates[k];
    if (c.params.size() > 1 &&
        (several >= EffortLimits::wide_in_pairs || c.params.size() > EffortLimits::widest_in_pairs))
      continue;
    several += c.params.size() > 1;
    choices.push_back({k, scores[k].variant});
    for (std::size_t v = 0; c.params.size() == 1 && v < c.variants.size(); ++v)
      if (v != scores[k].variant && !c.variants[v].between && field.contrasts[k][v].dof > 0)
        choices.push_back({k, v});
  }
  // Dear is what a pair leaves; first, and quickly, what it explains.
  struct Try {
    Choice a, b;
    double log_bayes;
  };
  std::vector<Try> tries;
  double top = 0.0;
  for (std::size_t i = 0; i < choices.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const inference::Candidate& a = field.set.candidates[choices[i].candidate];
      const inference::Candidate& b = field.set.candidates[choices[k].candidate];
      if (a.overlaps(b)) continue;
      const double evidence = quick_log_bayes(
          field.projected, distinct_columns_of(field.set, {choices[k], choices[i]}));
      if (evidence < top - ReachLimits::pair) continue;
      top = std::max(top, evidence);
      tries.push_back({choices[k], choices[i], evidence});
    }
  std::erase_if(tries, [&](const Try& t) { return t.log_bayes < top - ReachLimits::pair; });
  for (Try& t : tries)
    t.log_bayes = log_bayes(field.projected, distinct_columns_of(field.set, {t.a, t.b}));
  std::ranges::stable_sort(tries, std::ranges::greater{}, &Try::log_bayes);
  // Of each two candidates the best, and of those with one name the best two: room for different
  // ones.
  std::vector<Pair> kept;
  std::map<std::string, int> named;
  QuietTest test(field, library_threshold, scan_threshold);
  for (const Try& t : tries) {
    if (kept.size() == most) break;
    const bool seen = std::ranges::any_of(kept, [&](const Pair& k) {
      return k.a.candidate == t.a.candidate && k.b.candidate == t.b.candidate;
    });
    int& of_this_name = named[name_of(field, t.a, t.b)];
    if (seen || of_this_name == EffortLimits::pairs_of_a_name) continue;
    if (worth && !worth({t.a, t.b}, t.log_bayes)) continue;
    if (!test.quiet_beside({t.a, t.b})) continue;
    ++of_this_name;
    const inference::Contrast both = inference::make_contrast(
        field.projected.C, field.projected.raw, distinct_columns_of(field.set, {t.a, t.b}));
    const double T = both.T(field.projected.g);
    kept.push_back({t.a, t.b, T, both.dof, stats::strength(T, both.dof), t.log_bayes});
  }
  return kept;
}

}  // namespace drift::search
