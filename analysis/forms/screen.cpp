#include "analysis/forms/screen.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "analysis/forms/move_edges.hpp"
#include "analysis/forms/move_setting.hpp"
#include "core/stats/chi_square.hpp"
#include "mc/task/campaign.hpp"

namespace drift::forms {
namespace {

using Where = AttitudePart::Kind;
using When = TimePart::Kind;

Bins bins_for(const Timeline& timeline, Reach reach) {
  // The time of a screening goes with their square.
  constexpr std::size_t most_bins = 400, most_of_attitude = 200;
  return bins_of(timeline, reach == Reach::whole ? most_bins : most_of_attitude);
}

/// The best form of every pair of kinds. Tails are dear: within a pair and number of amplitudes the
/// largest T has the least.
class BestOfKinds {
 public:
  struct Entry {
    std::size_t where = 0, when = 0;
    double T = 0.0, start = 0.0, end = 0.0;  ///< start and end of a window
  };
  void take(Where where, When when, int dof, const Entry& entry) {
    Entry& best = best_[{where, when, dof}];
    if (entry.T > best.T) best = entry;
    ++tried_;
  }
  const auto& entries() const { return best_; }
  std::size_t tried() const { return tried_; }

 private:
  std::map<std::tuple<Where, When, int>, Entry> best_;
  std::size_t tried_ = 0;
};

/// An input of one time course, switched on in each position by itself.
struct ByPosition {
  std::array<std::array<MatX, 2>, 2> C;  ///< of cos and sin; shape (positions, positions)
  std::array<VecX, 2> g, raw;            ///< raw: root of it
};

ByPosition by_position(const PlaceInformation& info, const MatX& when, const Bins& bins,
                       int positions) {
  ByPosition out;
  const MatX none = MatX::Zero(positions, positions);
  for (Eigen::Index i = 0; i < when.cols(); ++i) {
    out.g[i] = out.raw[i] = VecX::Zero(positions);
    for (Eigen::Index b = 0; b < bins.size(); ++b) {
      out.g[i][bins.position[b]] += when(b, i) * info.g[b];
      out.raw[i][bins.position[b]] += std::abs(when(b, i)) * std::sqrt(info.raw[b]);
    }
    for (Eigen::Index k = 0; k <= i; ++k) {
      out.C[i][k] = none;
      for (Eigen::Index b = 0; b < bins.size(); ++b)
        for (Eigen::Index c = 0; c < bins.size(); ++c)
          out.C[i][k](bins.position[c], bins.position[b]) += when(c, i) * info.C(c, b) * when(b, k);
    }
  }
  return out;
}

/// T of one or two amplitudes by their information and gradient; 0 where one is not seen.
double score_of(double c11, double g1, double raw1) {
  return PlaceInformation::seen(c11, raw1 * raw1) ? g1 * g1 / c11 : 0.0;
}
double score_of(double c11, double c22, double c12, double g1, double g2, double raw) {
  const double det = c11 * c22 - c12 * c12;
  if (!PlaceInformation::seen(det / std::max(c11, c22), raw * raw)) return 0.0;
  return (c22 * g1 * g1 - 2.0 * c12 * g1 * g2 + c11 * g2 * g2) / det;
}

/// The forms of one place.
class PlaceScreen {
 public:
  PlaceScreen(const Grammar& grammar, const Instants& at, const Bins& bins,
              const PlaceInformation& info)
      : g_(grammar), at_(at), bins_(bins), info_(info) {
    positions_ = 1 + *std::max_element(bins.position.begin(), bins.position.end());
    VecX count = VecX::Zero(positions_);
    for (const int p : bins.position) count[p] += 1.0;
    for (const AttitudePart& part : g_.where) {
      const MatX mean = bins_.mean(columns_of(part, at_));
      MatX sums = MatX::Zero(positions_, mean.cols());
      for (Eigen::Index b = 0; b < bins_.size(); ++b) sums.row(bins_.position[b]) += mean.row(b);
      for (int p = 0; p < positions_; ++p)
        if (count[p] > 0.0) sums.row(p) /= count[p];
      where_.push_back(sums);
    }
  }

  BestOfKinds run(Reach reach) {
    for (std::size_t w = 1; w < g_.where.size(); ++w) attitude_alone(w);
    if (reach == Reach::attitude) return std::move(best_);
    for (std::size_t t = 1; t < g_.when.size(); ++t) with_time(t);
    windows();
    return std::move(best_);
  }

 private:
  void attitude_alone(std::size_t w) {
    const auto s = info_.score(bins_.mean(columns_of(g_.where[w], at_)));
    if (s.dof > 0) best_.take(g_.where[w].kind, When::one, s.dof, {w, 0, s.T});
  }
  void with_time(std::size_t t) {
    const MatX when = bins_.mean(columns_of(g_.when[t], at_));
    const ByPosition by = by_position(info_, when, bins_, positions_);
    const bool pair = when.cols() == 2;
    for (std::size_t w = 0; w < g_.where.size(); ++w) {
      const MatX& m = where_[w];
      double T = 0.0;
      if (!pair && m.cols() == 1) {
        const VecX a = m.col(0);
        T = score_of(a.dot(by.C[0][0] * a), a.dot(by.g[0]), a.cwiseAbs().dot(by.raw[0]));
      } else if (m.cols() == 1) {
        const VecX a = m.col(0);
        T = score_of(a.dot(by.C[0][0] * a), a.dot(by.C[1][1] * a), a.dot(by.C[1][0] * a),
                     a.dot(by.g[0]), a.dot(by.g[1]), a.cwiseAbs().dot(by.raw[0] + by.raw[1]));
      } else if (!pair) {
        const VecX a = m.col(0), b = m.col(1), Cb = by.C[0][0] * b;
        T = score_of(a.dot(by.C[0][0] * a), b.dot(Cb), a.dot(Cb), a.dot(by.g[0]), b.dot(by.g[0]),
                     (a.cwiseAbs() + b.cwiseAbs()).dot(by.raw[0]));
      } else {
        continue;  // two harmonics would have four amplitudes
      }
      best_.take(g_.where[w].kind, g_.when[t].kind, pair || m.cols() == 2 ? 2 : 1, {w, t, T});
    }
  }
  /// Every window of whole bins, by sums over rectangles.
  void windows() {
    const Eigen::Index n = bins_.size();
    MatX C = MatX::Zero(n + 1, n + 1);
    VecX g = VecX::Zero(n + 1), raw = VecX::Zero(n + 1);
    for (Eigen::Index i = 0; i < n; ++i) {
      g[i + 1] = g[i] + info_.g[i];
      raw[i + 1] = raw[i] + std::sqrt(info_.raw[i]);
      for (Eigen::Index k = 0; k < n; ++k)
        C(k + 1, i + 1) = C(k, i + 1) + C(k + 1, i) - C(k, i) + info_.C(k, i);
    }
    for (Eigen::Index a = 0; a < n; ++a)
      for (Eigen::Index b = a + 1; b < n; ++b) {  // up to the end it is an onset
        const double c = C(b, b) - 2.0 * C(a, b) + C(a, a);
        const double T = score_of(c, g[b] - g[a], raw[b] - raw[a]);
        best_.take(Where::one, When::window, 1,
                   {0, 0, T, bins_.start[static_cast<std::size_t>(a)],
                    bins_.start[static_cast<std::size_t>(b)]});
      }
  }

  const Grammar& g_;
  const Instants& at_;
  const Bins& bins_;
  const PlaceInformation& info_;
  int positions_ = 0;
  std::vector<MatX> where_;  ///< of each attitude part its means, shape (positions, columns)
  BestOfKinds best_;
};

/// A form of the best, its setting moved to where the score is largest, its chance paid for.
std::optional<ScreenedForm> screened(const Grammar& grammar, const OwnTarget& place,
                                     const BestOfKinds::Entry& e, When when, const Instants& at,
                                     const Bins& bins, const PlaceInformation& info, Reach reach) {
  ScreenedForm out;
  out.form.place = place;
  out.form.where = grammar.where[e.where];
  out.form.when = when == When::window
                      ? TimePart{When::window, 1, e.start, e.end, 0.5 * bins.length}
                      : grammar.when[e.when];
  out.form.log_prior = grammar.log_prior(out.form.where.kind, when);
  // The price is that of the grid's points: what a setting gains between them is not counted.
  const auto on_grid = info.score(bins.mean(columns_of(out.form, at)));
  if (on_grid.dof == 0) return std::nullopt;
  out.log_p = std::min(0.0, stats::log_tail(on_grid.T, on_grid.dof) - out.form.log_prior);
  if (reach == Reach::whole) out.form = with_setting_moved(out.form, at, bins, info);
  const auto s = info.score(bins.mean(columns_of(out.form, at)));
  out.T = s.T;
  out.dof = s.dof;
  out.amplitude = s.amplitude;
  return out;
}

}  // namespace

Screening screen_forms(const inference::LinearProblem& problem, const Timeline& timeline,
                       const inference::Projector& projector, std::size_t keep, Reach reach) {
  const Instants at = instants_of(timeline);
  const Bins bins = bins_for(timeline, reach);
  const auto read = [&](bool accelerometer) {
    return std::ranges::any_of(problem.tags, [&](const inference::RowTag& t) {
      return t.accelerometer() == accelerometer;
    });
  };
  const Grammar grammar = grammar_of(at, bins.start, bins.length, read(true), read(false));
  const auto of_places = mc::run_campaign(grammar.places.size(), [&](std::size_t k) {
    const OwnTarget& place = grammar.places[k];
    const PlaceInformation info = information_on(place, bins, problem, timeline, projector);
    const BestOfKinds best = PlaceScreen(grammar, at, bins, info).run(reach);
    Screening out;
    out.forms = best.tried();
    for (const auto& [kinds, entry] : best.entries())
      if (auto form = screened(grammar, place, entry, std::get<When>(kinds), at, bins, info, reach))
        out.best.push_back(std::move(*form));
    return out;
  });
  Screening all;
  for (const Screening& s : of_places) {
    all.forms += s.forms;
    all.best.insert(all.best.end(), s.best.begin(), s.best.end());
  }
  std::ranges::stable_sort(all.best, {}, &ScreenedForm::log_p);
  if (all.best.size() > keep) all.best.resize(keep);
  if (reach == Reach::whole)
    for (ScreenedForm& best : all.best)
      best.form = with_edges_moved(best.form, at, bins, problem, timeline, projector);
  return all;
}

VecX trace_of(const ScreenedForm& screened, const inference::MeasuredRows& rows,
              const Timeline& timeline, Reach reach) {
  const Bins bins = bins_for(timeline, reach);
  const MatX input = bins.mean(columns_of(screened.form, instants_of(timeline)));
  return signatures_of(screened.form.place, bins, rows, timeline) * (input * screened.amplitude);
}

}  // namespace drift::forms
