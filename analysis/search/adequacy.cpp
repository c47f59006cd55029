#include "analysis/search/adequacy.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <numeric>

#include "analysis/search/size_prior.hpp"

namespace drift::search {
namespace {

MatX rows_and_columns(const MatX& C, const std::vector<int>& a, const std::vector<int>& b) {
  MatX part(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < b.size(); ++k) part(i, k) = C(a[i], b[k]);
  return part;
}

VecX elements(const VecX& g, const std::vector<int>& a) {
  VecX part(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) part[i] = g[a[i]];
  return part;
}

/// Takes some columns out of C and g: their amplitudes are fitted freely.
struct Conditioner {
  std::vector<int> columns;
  MatX W;  ///< shape (columns, dof), C_DD^-1/2 on its observable part
  VecX y;  ///< W' g_D

  Conditioner(const MatX& C, const VecX& raw, const VecX& g, std::vector<int> taken)
      : columns(std::move(taken)) {
    const inference::Contrast c = inference::make_contrast(C, raw, columns);
    W = c.W;
    y = W.transpose() * elements(g, columns);
  }
  /// W' C_D,other: shape (dof, others).
  MatX cross(const MatX& C_D_other) const { return W.transpose() * C_D_other; }
};

/// Part of a column's information that must be left after conditioning for it to count as another.
constexpr double least_left = 1e-6;

}  // namespace

Field::Field(const inference::CandidateSet& candidates, const inference::Projected& p,
             const std::vector<inference::PositionScan>& windows)
    : set(&candidates), projected(&p), scans(&windows) {
  for (const inference::Candidate& c : candidates.candidates) {
    contrasts.emplace_back();
    for (const inference::Variant& v : c.variants)
      contrasts.back().push_back(inference::make_contrast(p.C, p.raw, v.columns));
  }
}

std::vector<inference::Contrast> Field::all_contrasts() const {
  std::vector<inference::Contrast> all;
  for (const auto& c : contrasts) all.insert(all.end(), c.begin(), c.end());
  return all;
}

double log_bayes(const inference::Projected& p, const std::vector<int>& columns) {
  return log_evidence_of_sizes(rows_and_columns(p.C, columns, columns), elements(p.g, columns));
}

Score score(const Field& field, std::size_t candidate) {
  Score best;
  best.strength = -1.0;
  const inference::Candidate& c = field.set->candidates[candidate];
  std::vector<double> evidence, share;
  for (std::size_t v = 0; v < c.variants.size(); ++v) {
    const inference::Contrast& contrast = field.contrasts[candidate][v];
    const double T = std::max(0.0, contrast.T(field.projected->g) - field.discount_of(candidate));
    const double s = stats::strength(T, contrast.dof);
    if (contrast.dof > 0 && s > best.strength) {
      best.variant = v;
      best.T = T;
      best.strength = s;
      best.dof = contrast.dof;
    }
    if (contrast.dof == 0) continue;  // an onset after the end of the test is no effect
    evidence.push_back(log_bayes(*field.projected, c.variants[v].columns) -
                       0.5 * field.discount_of(candidate));
    share.push_back(c.variants[v].share);
  }
  best.strength = std::max(best.strength, 0.0);
  if (evidence.empty()) return best;
  const double top = *std::max_element(evidence.begin(), evidence.end());
  const double whole = std::accumulate(share.begin(), share.end(), 0.0);
  double sum = 0.0;
  for (std::size_t k = 0; k < evidence.size(); ++k)
    sum += std::exp(evidence[k] - top) * share[k] / whole;
  best.log_bayes = top + std::log(sum);
  return best;
}

std::vector<std::size_t> best_settings(const Field& field, std::size_t candidate, double nearly,
                                       std::size_t most) {
  const auto& variants = field.set->candidates[candidate].variants;
  std::vector<double> evidence;
  for (std::size_t v = 0; v < variants.size(); ++v)
    evidence.push_back(field.contrasts[candidate][v].dof == 0
                           ? -1e300
                           : log_bayes(*field.projected, variants[v].columns));
  const double top = *std::max_element(evidence.begin(), evidence.end());
  std::vector<std::size_t> found;
  for (std::size_t v = 0; v < variants.size(); ++v) {
    const bool below_next = v + 1 < variants.size() && evidence[v + 1] > evidence[v];
    const bool below_last = v > 0 && evidence[v - 1] >= evidence[v];
    if (!below_next && !below_last && evidence[v] >= top - nearly) found.push_back(v);
  }
  std::stable_sort(found.begin(), found.end(),
                   [&](std::size_t a, std::size_t b) { return evidence[a] > evidence[b]; });
  if (found.size() > most) found.resize(most);
  return found;
}

std::vector<int> columns_of(const Field& field, const std::vector<Choice>& choices,
                            bool with_neighbours) {
  std::vector<int> columns;
  for (const Choice& choice : choices) {
    const inference::Candidate& c = field.set->candidates[choice.candidate];
    const auto add = [&](std::size_t v) {
      columns.insert(columns.end(), c.variants[v].columns.begin(), c.variants[v].columns.end());
    };
    add(choice.variant);
    if (!with_neighbours) continue;
    // The better of the two neighbours, where the other settings are the same.
    double best = -1.0;
    std::size_t neighbour = choice.variant;
    for (const std::size_t v : {choice.variant - 1, choice.variant + 1}) {
      if (v >= c.variants.size()) continue;
      const inference::Contrast& contrast = field.contrasts[choice.candidate][v];
      const double s = stats::strength(contrast.T(field.projected->g), contrast.dof);
      if (s > best) {
        best = s;
        neighbour = v;
      }
    }
    if (neighbour != choice.variant) add(neighbour);
  }
  std::sort(columns.begin(), columns.end());
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
  return columns;
}

Remainder remainder(const Field& field, const std::vector<Choice>& choices, double stop) {
  const inference::Projected& p = *field.projected;
  const Conditioner d(p.C, p.raw, p.g, columns_of(field, choices, true));
  std::vector<int> everything(p.g.size());
  for (std::size_t k = 0; k < everything.size(); ++k) everything[k] = static_cast<int>(k);
  const MatX cross = d.cross(rows_and_columns(p.C, d.columns, everything));  // (dof, K)
  const VecX g = p.g - cross.transpose() * d.y;
  const VecX left = p.C.diagonal() - cross.colwise().squaredNorm().transpose();

  Remainder out;
  const auto own = [&](const inference::Candidate& c) {
    for (const Choice& choice : choices) {
      const inference::Candidate& chosen = field.set->candidates[choice.candidate];
      if (chosen.term == c.term && (chosen.params == c.params || chosen.contains(c))) return true;
    }
    return false;
  };
  // Tails are dear: the largest T of each number of degrees is kept, and its tail taken when it
  // grows.
  std::size_t most = 1;
  for (const inference::Candidate& c : field.set->candidates)
    most = std::max(most, c.params.size());
  std::vector<double> largest(most + 1, 0.0);
  const auto take = [&](std::size_t candidate, double T, int dof) {
    if (dof <= 0 || !(T > largest[static_cast<std::size_t>(dof)])) return false;
    largest[static_cast<std::size_t>(dof)] = T;
    const double s = stats::strength(T, dof);
    if (s <= out.library) return false;
    out.library = s;
    out.strongest = candidate;
    return s > stop;
  };
  // Single columns first: they are quick, and most wrong causes fail on one of them.
  for (std::size_t k = 0; k < field.set->candidates.size(); ++k) {
    const inference::Candidate& c = field.set->candidates[k];
    if (c.params.size() > 1 || own(c)) continue;
    for (std::size_t v = 0; v < c.variants.size(); ++v) {
      const int j = c.variants[v].columns[0];
      if (field.contrasts[k][v].dof > 0 && left[j] > least_left * p.C(j, j) &&
          left[j] > 0.1 * inference::least_information &&
          take(k, g[j] * g[j] / left[j] - field.discount_of(k), 1))
        return out;
    }
  }
  for (std::size_t k = 0; k < field.set->candidates.size(); ++k) {
    const inference::Candidate& c = field.set->candidates[k];
    if (c.params.size() < 2 || own(c)) continue;
    for (const inference::Contrast& whole : field.contrasts[k]) {
      if (whole.dof == 0) continue;
      MatX cross_c(d.y.size(), whole.columns.size());
      for (std::size_t j = 0; j < whole.columns.size(); ++j)
        cross_c.col(j) = cross.col(whole.columns[j]);
      // In coordinates where the candidate had unit information.
      const MatX lost = cross_c * whole.W;
      const MatX rest = MatX::Identity(whole.dof, whole.dof) - lost.transpose() * lost;
      const Eigen::SelfAdjointEigenSolver<MatX> eigen(rest);
      const VecX y =
          eigen.eigenvectors().transpose() * (whole.W.transpose() * elements(g, whole.columns));
      double T = 0.0;
      int dof = 0;
      for (Eigen::Index j = 0; j < y.size(); ++j)
        if (eigen.eigenvalues()[j] > 1e-5) {
          T += y[j] * y[j] / eigen.eigenvalues()[j];
          ++dof;
        }
      if (take(k, T - field.discount_of(k), dof)) return out;
    }
  }
  for (const inference::PositionScan& scan : *field.scans) {
    MatX C_D_scan(d.columns.size(), scan.T.size());
    for (std::size_t k = 0; k < d.columns.size(); ++k)
      C_D_scan.row(k) = scan.scan.cross.col(d.columns[k]).transpose();
    const MatX cross_s = d.cross(C_D_scan);
    const VecX g_s = scan.scan.g - cross_s.transpose() * d.y;
    for (Eigen::Index k = 0; k < g_s.size(); ++k) {
      if (scan.T[k] == 0.0) continue;
      const double c = scan.scan.C(k, k) - cross_s.col(k).squaredNorm();
      if (c > 1e-5 * scan.scan.C(k, k)) out.scan = std::max(out.scan, g_s[k] * g_s[k] / c);
    }
  }
  out.scan = stats::strength(out.scan, 1);
  return out;
}

double cosine(const inference::Projected& p, const std::vector<int>& a, const std::vector<int>& b) {
  const inference::Contrast ca = inference::make_contrast(p.C, p.raw, a),
                            cb = inference::make_contrast(p.C, p.raw, b);
  if (ca.dof == 0 || cb.dof == 0) return 0.0;
  const MatX m = ca.W.transpose() * rows_and_columns(p.C, a, b) * cb.W;
  if (ca.dof == 1 && cb.dof == 1) return m(0, 0);
  return Eigen::JacobiSVD<MatX>(m).singularValues()[0];
}

}  // namespace drift::search
