#include "analysis/search/pairs.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "core/base/rng.hpp"

namespace drift::search {
namespace {

constexpr double one_direction = 0.9999;
constexpr double too_little =
    22.0;  // log evidence behind the best pair: a million, and what the sizes are worth

/// A single observable column that a candidate has.
struct Unit {
  Choice choice;
  int column = 0;
};

std::vector<Unit> single_columns(const Field& field) {
  std::vector<Unit> units;
  for (std::size_t c = 0; c < field.set->candidates.size(); ++c)
    for (std::size_t v = 0; v < field.set->candidates[c].variants.size(); ++v)
      if (field.contrasts[c][v].columns.size() == 1 && field.contrasts[c][v].dof == 1 &&
          field.discount_of(c) == 0.0)
        units.push_back({{c, v}, field.contrasts[c][v].columns[0]});
  return units;
}

/// Correlations of the units' scores, and the scores with unit variance.
MatX correlations(const Field& field, const std::vector<Unit>& units, VecX& z) {
  const MatX& C = field.projected->C;
  const auto n = static_cast<Eigen::Index>(units.size());
  MatX rho(n, n);
  z.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double s = std::sqrt(C(units[i].column, units[i].column));
    z[i] = field.projected->g[units[i].column] / s;
    for (Eigen::Index k = 0; k < n; ++k)
      rho(i, k) = C(units[i].column, units[k].column) /
                  (s * std::sqrt(C(units[k].column, units[k].column)));
  }
  return rho;
}

double joint(double za, double zb, double rho) {
  return (za * za + zb * zb - 2.0 * rho * za * zb) / (1.0 - rho * rho);
}

/// What a pair would be called: terms and axes.
std::string name_of(const Field& field, const Pair& p) {
  const auto name = [&](const Choice& c) {
    const inference::Candidate& candidate = field.set->candidates[c.candidate];
    return candidate.term + "." + candidate.axis;
  };
  const std::string a = name(p.a), b = name(p.b);
  return a < b ? a + " " + b : b + " " + a;
}

/// The best of each two candidates, and of those with one name the best two: room for different
/// ones.
std::vector<Pair> diverse(const Field& field, const std::vector<Pair>& sorted, std::size_t most) {
  std::vector<Pair> kept;
  std::map<std::string, int> named;
  for (const Pair& p : sorted) {
    if (kept.size() == most) break;
    const bool seen = std::any_of(kept.begin(), kept.end(), [&](const Pair& k) {
      return k.a.candidate == p.a.candidate && k.b.candidate == p.b.candidate;
    });
    if (!seen && ++named[name_of(field, p)] <= 2) kept.push_back(p);
  }
  return kept;
}

/// Log evidence of a few columns with unit priors: what the choice among thousands of pairs needs.
double quick_log_bayes(const inference::Projected& p, const std::vector<int>& columns) {
  const auto n = static_cast<Eigen::Index>(columns.size());
  MatX A(n, n);
  VecX g(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    g[i] = p.g[columns[static_cast<std::size_t>(i)]];
    for (Eigen::Index k = 0; k < n; ++k)
      A(i, k) = p.C(columns[static_cast<std::size_t>(i)], columns[static_cast<std::size_t>(k)]) +
                (i == k ? 1.0 : 0.0);
  }
  const Eigen::LLT<MatX> llt(A);
  const MatX L = llt.matrixL();
  return 0.5 * g.dot(llt.solve(g)) - L.diagonal().array().log().sum();
}

bool same_candidate(const Unit& a, const Unit& b) {
  return a.choice.candidate == b.choice.candidate;
}

}  // namespace

std::vector<Pair> strongest_pairs(const Field& field, std::size_t most) {
  const auto units = single_columns(field);
  VecX z;
  const MatX rho = correlations(field, units, z);
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < units.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      if (same_candidate(units[i], units[k]) || std::abs(rho(i, k)) > one_direction) continue;
      const double T = joint(z[i], z[k], rho(i, k));
      if (pairs.size() == most && T <= pairs.back().T) continue;
      if (pairs.size() == most) pairs.pop_back();
      Pair p{units[k].choice, units[i].choice, T, 2, 0.5 * T, 0.0};
      pairs.insert(std::upper_bound(pairs.begin(), pairs.end(), p,
                                    [](const Pair& a, const Pair& b) { return a.T > b.T; }),
                   p);
    }
  for (Pair& p : pairs)
    p.log_bayes = log_bayes(*field.projected, columns_of(field, {p.a, p.b}, false));
  return pairs;
}

inference::MaxNull pair_null(const Field& field, int draws) {
  const auto units = single_columns(field);
  VecX z;
  const MatX rho = correlations(field, units, z);
  const MatX g = inference::MaxNull::draw(rho, draws, 2);
  VecX largest = VecX::Zero(draws);
  for (std::size_t i = 0; i < units.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const double r = rho(i, k);
      if (same_candidate(units[i], units[k]) || std::abs(r) > one_direction) continue;
      const double w = 1.0 / (1.0 - r * r);
      for (int d = 0; d < draws; ++d) {
        const double a = g(d, i), b = g(d, k);
        largest[d] = std::max(largest[d], (a * a + b * b - 2.0 * r * a * b) * w);
      }
    }
  return inference::MaxNull::of(0.5 * largest);
}

std::vector<Pair> adequate_pairs(const Field& field, const std::vector<Score>& scores,
                                 double library_threshold, double scan_threshold,
                                 std::size_t most) {
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
    const inference::Candidate& c = field.set->candidates[k];
    if (c.params.size() > 1 && (several >= 12 || c.params.size() > 6)) continue;
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
      const inference::Candidate& a = field.set->candidates[choices[i].candidate];
      const inference::Candidate& b = field.set->candidates[choices[k].candidate];
      if (choices[i].candidate == choices[k].candidate || a.contains(b) || b.contains(a)) continue;
      const double evidence =
          quick_log_bayes(*field.projected, columns_of(field, {choices[k], choices[i]}, false));
      if (evidence < top - too_little) continue;
      top = std::max(top, evidence);
      tries.push_back({choices[k], choices[i], evidence});
    }
  std::erase_if(tries, [&](const Try& t) { return t.log_bayes < top - too_little; });
  std::vector<Pair> found;
  for (const Try& t : tries) {
    const std::vector<Choice> pair{t.a, t.b};
    const Remainder r = remainder(field, pair, library_threshold);
    if (r.library > library_threshold || r.scan > scan_threshold) continue;
    const auto columns = columns_of(field, pair, false);
    const inference::Contrast both =
        inference::make_contrast(field.projected->C, field.projected->raw, columns);
    const double T = both.T(field.projected->g);
    found.push_back({t.a, t.b, T, both.dof, stats::strength(T, both.dof),
                     log_bayes(*field.projected, columns)});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Pair& a, const Pair& b) { return a.log_bayes > b.log_bayes; });
  return diverse(field, found, most);
}

std::vector<Choice> greedy(const Field& field, const std::vector<Score>& scores,
                           double library_threshold, double scan_threshold, std::size_t most) {
  std::vector<Choice> in;
  std::size_t next = 0;
  for (std::size_t k = 1; k < scores.size(); ++k)
    if (scores[k].strength > scores[next].strength) next = k;
  const auto quiet = [&](const Remainder& r) {
    return r.library <= library_threshold && r.scan <= scan_threshold;
  };
  Remainder r;
  do {
    in.push_back({next, scores[next].variant});
    r = remainder(field, in, 1e300);
    next = r.strongest;
  } while (!quiet(r) && in.size() < most && r.library > library_threshold);
  if (!quiet(r)) return {};
  for (std::size_t k = 0; k < in.size() && in.size() > 1;) {
    std::vector<Choice> fewer = in;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
    if (quiet(remainder(field, fewer, 1e300))) {
      in = fewer;
      k = 0;
    } else {
      ++k;
    }
  }
  return in;
}

}  // namespace drift::search
