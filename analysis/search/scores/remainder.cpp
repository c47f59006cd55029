#include "analysis/search/scores/remainder.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/inference/thresholds.hpp"
#include "core/base/decompose.hpp"

namespace drift::search {
namespace {

using inference::VisibleLimits;

/// Columns of simultaneous causes, each with the better of its neighbouring variants.
std::vector<int> columns_with_neighbours(const Field& field, std::vector<Choice> choices) {
  const std::size_t chosen = choices.size();
  for (std::size_t k = 0; k < chosen; ++k) {
    const auto [candidate, variant] = choices[k];
    const inference::Candidate& c = field.set.candidates[candidate];
    double best = -1.0;
    std::size_t neighbour = variant;
    for (const std::size_t v : {variant - 1, variant + 1}) {
      if (v >= c.variants.size()) continue;
      const inference::Contrast& contrast = field.contrasts[candidate][v];
      const double s = stats::strength(contrast.T(field.projected.g), contrast.dof);
      if (s > best) {
        best = s;
        neighbour = v;
      }
    }
    choices.push_back({candidate, neighbour});
  }
  return distinct_columns_of(field.set, choices);
}

/// Takes some columns out of C and g: their amplitudes are fitted freely.
class Conditioned {
 public:
  Conditioned(const Field& field, std::vector<int> taken)
      : field_(field), columns_(std::move(taken)) {
    const inference::Projected& p = field.projected;
    W_ = inference::make_contrast(p.C, p.raw, columns_).W;
    y_ = W_.transpose() * p.g(columns_);
    cross_ = onto_taken(p.C);
    g_ = p.g - cross_ * y_;
    left_ = p.C.diagonal() - cross_.rowwise().squaredNorm();
  }

  /// T of one column; 0 where nothing of it is left.
  double T_of(int column) const {
    const bool seen =
        left_[column] > VisibleLimits::left * field_.projected.C(column, column) &&
        left_[column] > VisibleLimits::information_beside * VisibleLimits::information;
    return seen ? g_[column] * g_[column] / left_[column] : 0.0;
  }

  struct Several {
    double T = 0.0;
    int dof = 0;
  };
  /// T of several columns, on the directions of which something is left. whole: their contrast
  /// before. harmless: by degrees of freedom, what T need not be told apart below: where a bound is
  /// smaller that is returned, and no eigenvalues are worked out.
  Several T_of(const inference::Contrast& whole, const std::vector<double>& harmless) const {
    // In coordinates where the candidate had unit information.
    const MatX cross = cross_(whole.columns, Eigen::all);
    const MatX lost = cross.transpose() * whole.W;
    const VecX score = whole.W.transpose() * g_(whole.columns);
    const double least = 1.0 - lost.squaredNorm();  // no eigenvalue of what is left is smaller
    if (least > VisibleLimits::left_of_several) {
      const double bound = score.squaredNorm() / least;
      if (bound <= harmless[static_cast<std::size_t>(whole.dof)]) return {bound, whole.dof};
    }
    const MatX rest = MatX::Identity(whole.dof, whole.dof) - lost.transpose() * lost;
    const Eigensystem eigen = eigensystem(rest);
    const VecX y = eigen.vectors.transpose() * score;
    Several out;
    for (Eigen::Index j = 0; j < y.size(); ++j)
      if (eigen.values[j] > VisibleLimits::left_of_several) {
        out.T += y[j] * y[j] / eigen.values[j];
        ++out.dof;
      }
    return out;
  }

  /// The largest T of the windows of a position.
  double largest_T(const inference::PositionScan& scan) const {
    const MatX cross = onto_taken(scan.scan.cross);
    const VecX g = scan.scan.g - cross * y_;
    double largest = 0.0;
    for (Eigen::Index k = 0; k < g.size(); ++k) {
      if (scan.T[k] == 0.0) continue;
      const double c = scan.scan.C(k, k) - cross.row(k).squaredNorm();
      if (c > VisibleLimits::left_of_several * scan.scan.C(k, k))
        largest = std::max(largest, g[k] * g[k] / c);
    }
    return largest;
  }

 private:
  /// Of some columns' information with all others, that with those that are taken, made white.
  MatX onto_taken(const MatX& with_all) const {
    const MatX with_taken = with_all(Eigen::all, columns_);  // Eigen multiplies no view at speed
    return with_taken * W_;
  }

  const Field& field_;
  std::vector<int> columns_;
  MatX W_;      ///< shape (columns, dof), C_DD^-1/2 on its observable part
  VecX y_;      ///< W' g_D
  MatX cross_;  ///< C_all,D W: shape (K, dof)
  VecX g_, left_;
};

/// The largest T of each number of degrees: tails are dear, and taken only when it grows.
class Largest {
 public:
  explicit Largest(const inference::CandidateSet& set) {
    std::size_t most = 1;
    for (const inference::Candidate& c : set.candidates) most = std::max(most, c.params.size());
    by_dof_.assign(most + 1, 0.0);
  }
  /// The strength of T where it is the largest of its degrees so far, else 0.
  double strength_if_larger(double T, int dof) {
    if (dof <= 0 || !(T > by_dof_[static_cast<std::size_t>(dof)])) return 0.0;
    by_dof_[static_cast<std::size_t>(dof)] = T;
    return stats::strength(T, dof);
  }
  const std::vector<double>& by_dof() const { return by_dof_; }

 private:
  std::vector<double> by_dof_;
};

/// What the strength of a candidate is beside the causes, at those of its settings that exceed what
/// `known` has seen.
double strength_beside(const Field& field, const Conditioned& given, std::size_t candidate,
                       Largest& known) {
  const bool single = field.set.candidates[candidate].params.size() == 1;
  const double discount = field.discount_of(candidate);
  double strength = 0.0;
  for (const inference::Contrast& whole : field.contrasts[candidate]) {
    if (whole.dof == 0) continue;
    const auto [T, dof] = single ? Conditioned::Several{given.T_of(whole.columns[0]), 1}
                                 : given.T_of(whole, known.by_dof());
    strength = std::max(strength, known.strength_if_larger(T - discount, dof));
  }
  return strength;
}

}  // namespace

Remainder remainder(const Field& field, const std::vector<Choice>& choices) {
  const Conditioned given(field, columns_with_neighbours(field, choices));
  Remainder out;
  Largest known(field.set);
  for (std::size_t k = 0; k < field.set.candidates.size(); ++k) {
    if (of_a_chosen_family(field.set, choices, field.set.candidates[k])) continue;
    const double strength = strength_beside(field, given, k, known);
    if (strength <= out.library) continue;
    out.library = strength;
    out.strongest = k;
  }
  double T = 0.0;
  for (const inference::PositionScan& scan : field.scans) T = std::max(T, given.largest_T(scan));
  out.scan = stats::strength(T, 1);
  return out;
}

QuietTest::QuietTest(const Field& field, double library_threshold, double scan_threshold)
    : field_(field), library_threshold_(library_threshold), scan_threshold_(scan_threshold) {
  const auto single = [&](std::size_t k) { return field.set.candidates[k].params.size() == 1; };
  for (std::size_t k = 0; k < field.set.candidates.size(); ++k)
    if (single(k)) asked_.push_back({Asked::What::candidate, k});
  for (std::size_t k = 0; k < field.scans.size(); ++k) asked_.push_back({Asked::What::windows, k});
  for (std::size_t k = 0; k < field.set.candidates.size(); ++k)
    if (!single(k)) asked_.push_back({Asked::What::candidate, k});
}

bool QuietTest::quiet_beside(const std::vector<Choice>& choices) {
  const Conditioned given(field_, columns_with_neighbours(field_, choices));
  Largest known(field_.set);
  const auto objects = [&](const Asked& who) {
    if (who.what == Asked::What::windows)
      return stats::strength(given.largest_T(field_.scans[who.number]), 1) > scan_threshold_;
    return !of_a_chosen_family(field_.set, choices, field_.set.candidates[who.number]) &&
           strength_beside(field_, given, who.number, known) > library_threshold_;
  };
  const auto objector = std::ranges::find_if(asked_, objects);
  if (objector == asked_.end()) return true;
  std::rotate(asked_.begin(), objector, objector + 1);
  return false;
}

}  // namespace drift::search
