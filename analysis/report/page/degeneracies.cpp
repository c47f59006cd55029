#include "analysis/report/page/degeneracies.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "analysis/report/page/known_degeneracies.hpp"
#include "core/base/check.hpp"
#include "core/base/number_text.hpp"

namespace drift::report {
namespace {

MatX rows_of(const std::vector<WeakDirection>& directions, Eigen::Index n) {
  MatX rows(static_cast<Eigen::Index>(directions.size()), n);
  for (Eigen::Index r = 0; r < rows.rows(); ++r)
    rows.row(r) = directions[static_cast<std::size_t>(r)].direction.transpose();
  return rows;
}

constexpr const char* turned_drift_reason =
    "misalignment with drift: by eq. (6) in free drift it turns drift to another axis alone (E u), "
    "and the gyro there may drift so itself";

std::string limit_text() {
  return number_text(std::sqrt(unseen_information));  // [sigma] per prior sigma
}

/// Writes directions over the prior-scaled layout.
class Writer {
 public:
  Writer(const Layout& layout, const Mounting& mounting, const UnseenSpace& space)
      : layout_(layout), mounting_(mounting), space_(space), column_(layout.size()) {
    for (std::size_t k = 0; k < layout.size(); ++k)
      column_[k] = space.information_root.col(static_cast<Eigen::Index>(k)).norm();
  }

  /// keep: a state that is written in any case. exact: rounding alone is left of the direction.
  NamedDirection written(const VecX& v, Eigen::Index keep, bool exact) const {
    NamedDirection out;
    const std::vector<Eigen::Index> states = needed(v, keep);
    constexpr int fewest = 3, all = std::numeric_limits<double>::max_digits10;
    for (int digits = fewest; digits <= all; ++digits) {
      out = in_words(states, v, digits);
      if (std::pow(signal_of(as_written(out)), 2) < unseen_information) break;
    }
    out.signal = signal_of(as_written(out));
    if (states.size() == 1) {
      exact = out.signal == 0.0;
      out.unrounded = out.signal;
      out.reason = no_signal_reason(out.parts.front().param, exact, mounting_, space_.excitation);
    } else {
      out.unrounded = exact ? 0.0 : signal_of(v);
      out.reason = turned_drift(out) ? turned_drift_reason : "";
    }
    return out;
  }

 private:
  /// As few states as leave v unseen, those first that are seen best; in library order, as rate and
  /// readout parameters may alternate.
  std::vector<Eigen::Index> needed(const VecX& v, Eigen::Index keep) const {
    std::vector<Eigen::Index> states(layout_.size());
    std::iota(states.begin(), states.end(), Eigen::Index{0});
    const auto seen = [&](Eigen::Index k) {
      return k == keep ? std::numeric_limits<double>::infinity()
                       : column_[static_cast<std::size_t>(k)] * std::abs(v[k]);
    };
    std::ranges::stable_sort(states, std::greater{}, seen);
    VecX signal = VecX::Zero(space_.information_root.rows());
    double square = 0.0;
    std::size_t count = 0;
    do {
      const Eigen::Index k = states[count++];
      signal += v[k] * space_.information_root.col(k);
      square += v[k] * v[k];
    } while (count < states.size() && seen(states[count]) > 0.0 &&
             signal.squaredNorm() >= unseen_information * square);
    states.resize(count);
    std::ranges::sort(states, {}, [&](Eigen::Index k) { return param(k); });
    return states;
  }

  NamedDirection in_words(const std::vector<Eigen::Index>& states, const VecX& v,
                          int digits) const {
    NamedDirection out;
    double first = 0.0;
    for (const Eigen::Index k : states) {
      const double natural = v[k] / per_unit(k);
      if (first == 0.0) first = natural;
      const double c = natural / first;
      const std::string size = number_text(std::abs(c), digits);
      out.parts.push_back({param(k), std::copysign(std::stod(size), c)});
      if (!out.combination.empty()) out.combination += c < 0.0 ? " - " : " + ";
      out.combination +=
          (size == "1" ? "" : size + " ") + std::string(TermLibrary::specs[param(k)].key.view());
    }
    return out;
  }

  /// Whether it is of misalignments and of drifts, where the former do no more than turn the
  /// latter: by eq. (6) without commands (physics.md 1.8).
  bool turned_drift(const NamedDirection& direction) const {
    const auto of = [](const NamedDirection::Part& part, std::string_view term) {
      return TermLibrary::owner(part.param).key == term;
    };
    const auto misalignment = [&](const auto& part) { return of(part, "gyro_misalignment"); };
    const auto either = [&](const auto& part) {
      return misalignment(part) || of(part, "fixed_drift") || of(part, "g_drift") ||
             of(part, "g2_drift");
    };
    return space_.coupling == Coupling::eq6 &&
           std::ranges::none_of(space_.excitation.commanded, std::identity()) &&
           std::ranges::any_of(direction.parts, misalignment) &&
           std::ranges::all_of(direction.parts, either);
  }

  VecX as_written(const NamedDirection& direction) const {
    VecX v = VecX::Zero(static_cast<Eigen::Index>(layout_.size()));
    for (const NamedDirection::Part& part : direction.parts) {
      const auto k = std::ranges::find(layout_.params, part.param) - layout_.params.begin();
      v[k] = part.coefficient * per_unit(k);
    }
    return v;
  }
  /// Of a prior sigma along v [sigma]; 0 if nothing but rounding.
  double signal_of(const VecX& v) const {
    const double signal = (space_.information_root * v).norm() / v.norm();
    return signal <= rounding_signal(space_.information_root) ? 0.0 : signal;
  }

  std::size_t param(Eigen::Index k) const { return layout_.params[static_cast<std::size_t>(k)]; }
  /// Prior sigmas in a parameter's unit.
  double per_unit(Eigen::Index k) const {
    return TermLibrary::specs[param(k)].unit.to_si / layout_.sigma[k];
  }

  const Layout& layout_;
  const Mounting& mounting_;
  const UnseenSpace& space_;
  std::vector<double> column_;  ///< signal of a prior sigma of each parameter alone [sigma]
};

/// A space in reduced row echelon form, which grows by a direction at a time.
class Echelon {
 public:
  /// v without what lies along the directions that are in.
  VecX reduced(VecX v) const {
    for (std::size_t i = 0; i < pivots_.size(); ++i) v -= v[pivots_[i]] * rows_[i];
    for (const Eigen::Index pivot : pivots_) v[pivot] = 0.0;  // but for rounding
    return v;
  }
  /// v: reduced. Returns the place of the direction.
  std::size_t add(VecX v, Eigen::Index pivot) {
    v /= v[pivot];
    for (VecX& row : rows_) row -= (row[pivot] * v).eval();
    rows_.push_back(std::move(v));
    pivots_.push_back(pivot);
    return rows_.size() - 1;
  }
  /// Adds so many directions of the span of `rows`, always that with the largest pivot.
  void add_largest(MatX rows, std::size_t count) {
    constexpr double nothing_left = 1e-6;  // of unit vectors
    for (; count > 0 && rows.size() > 0; --count) {
      for (Eigen::Index r = 0; r < rows.rows(); ++r)
        rows.row(r) = reduced(rows.row(r).transpose()).transpose();
      Eigen::Index r = 0, pivot = 0;
      if (!(rows.cwiseAbs().maxCoeff(&r, &pivot) > nothing_left)) return;
      add(rows.row(r).transpose(), pivot);
      rows.row(r).setZero();
    }
  }
  std::size_t size() const { return rows_.size(); }
  const VecX& row(std::size_t i) const { return rows_[i]; }
  Eigen::Index pivot(std::size_t i) const { return pivots_[i]; }

 private:
  std::vector<VecX> rows_;  ///< 1 at their own pivot, 0 at those of the others
  std::vector<Eigen::Index> pivots_;
};

/// Names so many further directions of a space: those that are known and lie in it, then others.
void name_further(std::vector<NamedDirection>& all, Echelon& echelon, const Writer& writer,
                  const std::vector<KnownDegeneracy>& known, const MatX& basis, std::size_t count,
                  bool exact) {
  constexpr double own_part = 0.1;  // of a unit vector, that those before leave of a known one
  std::vector<NamedDirection> others;
  const std::size_t end = echelon.size() + count;
  for (const KnownDegeneracy& one : known) {
    if (echelon.size() == end) break;
    const VecX v = one.direction.normalized(), inside = basis.transpose() * (basis * v);
    if ((v - inside).norm() > one.tolerance) continue;
    const VecX further = echelon.reduced(inside);
    Eigen::Index pivot = 0, largest = 0;
    if (further.cwiseAbs().maxCoeff(&pivot) < own_part) continue;
    inside.cwiseAbs().maxCoeff(&largest);
    NamedDirection direction = writer.written(inside, largest, exact);
    const bool single = one.reason.empty();
    if (single != (direction.parts.size() == 1)) continue;  // it takes less, or more
    if (!single) direction.reason = one.reason;
    direction.anywhere = one.anywhere;
    (single ? others : all).push_back(std::move(direction));
    echelon.add(further, pivot);
  }
  const std::size_t first = echelon.size();
  echelon.add_largest(basis, end - first);
  for (std::size_t i = first; i < echelon.size(); ++i)
    others.push_back(writer.written(echelon.row(i), echelon.pivot(i), exact));
  std::ranges::stable_sort(others, {}, [](const auto& d) { return d.parts.front().param; });
  std::ranges::move(others, std::back_inserter(all));
}

}  // namespace

std::vector<NamedDirection> name_degeneracies(const Layout& layout, const Mounting& mounting,
                                              const UnseenSpace& space,
                                              const std::vector<WeakDirection>& but) {
  std::vector<NamedDirection> all;
  if (space.directions.size() <= but.size()) return all;
  const auto n = static_cast<Eigen::Index>(layout.size());
  DRIFT_DEMAND(space.information_root.cols() == n);
  const Writer writer(layout, mounting, space);
  const std::vector<KnownDegeneracy> known = known_degeneracies(layout, mounting);
  const MatX basis = rows_of(space.directions, n);
  Echelon echelon;
  echelon.add_largest(rows_of(but, n), but.size());
  // Those of which rounding alone is left, the weakest, are not mixed with others.
  const std::size_t exact =
      but.empty() ? exactly_unseen(space.directions, space.information_root) : 0;
  name_further(all, echelon, writer, known, basis.topRows(static_cast<Eigen::Index>(exact)), exact,
               true);
  if (space.directions.size() > echelon.size())
    name_further(all, echelon, writer, known, basis, space.directions.size() - echelon.size(),
                 false);
  return all;
}

std::string unseen_text(const std::vector<WeakDirection>& directions,
                        const MatX& information_root) {
  const std::size_t exact = exactly_unseen(directions, information_root);
  const std::size_t weak = directions.size() - exact;
  std::vector<std::string> said;
  if (exact > 0 || weak == 0)
    said.push_back(fmt::format("{} {} not seen at all", exact, exact == 1 ? "is" : "are"));
  if (weak > 0)
    said.push_back(fmt::format("{} leave{} less than {} sigma at a prior sigma", weak,
                               weak == 1 ? "s" : "", limit_text()));
  return fmt::format("{}", fmt::join(said, ", "));
}

Table direction_table(std::string title) {
  return {
      std::move(title), "signal | unrounded | <direction, each parameter in its unit",
      fmt::format("signal: what one prior sigma along the direction as it is written leaves in the "
                  "data, in sigmas of their noise; unrounded: the same with all its parts and "
                  "digits, 0 where that is rounding alone. Parts and digits are as many as it "
                  "takes to leave less than {} as written.",
                  limit_text())};
}

void add_directions(Table& table, const std::vector<NamedDirection>& directions) {
  std::vector<std::string> reasons;
  for (const NamedDirection& d : directions)
    if (std::ranges::find(reasons, d.reason) == reasons.end()) reasons.push_back(d.reason);
  for (const std::string& reason : reasons) {
    table.add_heading((reason.empty() ? "for no known reason" : reason) + ":");
    for (const NamedDirection& d : directions)
      if (d.reason == reason) table.add({d.signal, d.unrounded, d.combination});
  }
}

}  // namespace drift::report
