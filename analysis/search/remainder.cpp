#include "analysis/search/remainder.hpp"

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
    cross_ = W_.transpose() * p.C(columns_, Eigen::all);
    g_ = p.g - cross_.transpose() * y_;
    left_ = p.C.diagonal() - cross_.colwise().squaredNorm().transpose();
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
  /// before.
  Several T_of(const inference::Contrast& whole) const {
    // In coordinates where the candidate had unit information.
    const MatX lost = cross_(Eigen::all, whole.columns) * whole.W;
    const MatX rest = MatX::Identity(whole.dof, whole.dof) - lost.transpose() * lost;
    const Eigensystem eigen = eigensystem(rest);
    const VecX y = eigen.vectors.transpose() * (whole.W.transpose() * g_(whole.columns));
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
    const MatX cross = W_.transpose() * scan.scan.cross(Eigen::all, columns_).transpose();
    const VecX g = scan.scan.g - cross.transpose() * y_;
    double largest = 0.0;
    for (Eigen::Index k = 0; k < g.size(); ++k) {
      if (scan.T[k] == 0.0) continue;
      const double c = scan.scan.C(k, k) - cross.col(k).squaredNorm();
      if (c > VisibleLimits::left_of_several * scan.scan.C(k, k))
        largest = std::max(largest, g[k] * g[k] / c);
    }
    return largest;
  }

 private:
  const Field& field_;
  std::vector<int> columns_;
  MatX W_;      ///< shape (columns, dof), C_DD^-1/2 on its observable part
  VecX y_;      ///< W' g_D
  MatX cross_;  ///< W' C_D,all: shape (dof, K)
  VecX g_, left_;
};

/// The strongest candidate. Tails are dear: the largest T of each number of degrees is kept, and
/// its tail taken when it grows.
class Strongest {
 public:
  explicit Strongest(const inference::CandidateSet& set) {
    std::size_t most = 1;
    for (const inference::Candidate& c : set.candidates) most = std::max(most, c.params.size());
    largest_.assign(most + 1, 0.0);
  }
  void take(std::size_t candidate, double T, int dof) {
    if (dof <= 0 || !(T > largest_[static_cast<std::size_t>(dof)])) return;
    largest_[static_cast<std::size_t>(dof)] = T;
    if (const double s = stats::strength(T, dof); s > strength_) {
      strength_ = s;
      candidate_ = candidate;
    }
  }
  double strength() const { return strength_; }
  std::size_t candidate() const { return candidate_; }

 private:
  std::vector<double> largest_;
  double strength_ = 0.0;
  std::size_t candidate_ = 0;
};

/// Single columns first: they are quick, and most wrong causes fail on one of them.
Strongest strongest_other(const Field& field, const std::vector<Choice>& choices,
                          const Conditioned& given, double stop) {
  Strongest found(field.set);
  for (const bool single : {true, false})
    for (std::size_t k = 0; k < field.set.candidates.size(); ++k) {
      const inference::Candidate& c = field.set.candidates[k];
      if ((c.params.size() == 1) != single || of_a_chosen_family(field.set, choices, c)) continue;
      for (const inference::Contrast& whole : field.contrasts[k]) {
        if (whole.dof == 0) continue;
        const auto [T, dof] =
            single ? Conditioned::Several{given.T_of(whole.columns[0]), 1} : given.T_of(whole);
        found.take(k, T - field.discount_of(k), dof);
        if (found.strength() > stop) return found;
      }
    }
  return found;
}

}  // namespace

Remainder remainder(const Field& field, const std::vector<Choice>& choices, double stop) {
  const Conditioned given(field, columns_with_neighbours(field, choices));
  const Strongest other = strongest_other(field, choices, given, stop);
  Remainder out{other.strength(), 0.0, other.candidate()};
  if (out.library > stop) return out;
  double T = 0.0;
  for (const inference::PositionScan& scan : field.scans) T = std::max(T, given.largest_T(scan));
  out.scan = stats::strength(T, 1);
  return out;
}

}  // namespace drift::search
