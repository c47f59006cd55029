#include "analysis/observability/other_methods.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace drift::observability {
namespace {

std::string_view key_of_state(const Ranking& r, std::size_t state) {
  return TermLibrary::specs[r.layout.params[state]].key.view();
}

/// The direction a state takes most part in.
const EigenDirection& home_of(const Ranking& r, std::size_t state) {
  return *std::ranges::max_element(r.spectrum, {},
                                   [&](const EigenDirection& d) { return d.participation(state); });
}

std::string conditional_reason(const Ranking& r, std::size_t state, bool higher_here) {
  const ParameterRank& p = r.parameters[state];
  if (!higher_here)
    return fmt::format("little else is mistaken for it: collinearity {:.3g}, others lose more",
                       p.collinearity());
  return fmt::format(
      "seen well if the others were known, but confused with {} (correlation {:.4f}, "
      "collinearity {:.3g})",
      key_of_state(r, p.partner), p.correlation, p.collinearity());
}

/// What the stripped observability matrix leaves out of a plan.
struct LeftOut {
  VecX on_the_way;      ///< share of each parameter's bits that slews and turns of the case give
  double turned = 0.0;  ///< by the Earth in the longest dwell of free drift [deg]
};

LeftOut left_out(const LinearisedPlan& plan, const InformationCourse& course,
                 const TestPlan& positions) {
  LeftOut out{VecX::Zero(course.gain.rows()), 0.0};
  for (std::size_t b = 0; b < plan.bins.size(); ++b)
    if (plan.bins[b].slew) out.on_the_way += course.gain.col(static_cast<Eigen::Index>(b));
  out.on_the_way = out.on_the_way.cwiseQuotient(course.gain.rowwise().sum().cwiseMax(1e-12));
  for (const Position& p : positions.positions)
    if (p.mode == CommandLaw::free)
      out.turned = std::max(out.turned, detail::earth_rate * p.dwell / detail::deg);
  return out;
}

std::string svd_reason(const Ranking& r, std::size_t state, bool higher_here,
                       const LeftOut& left_out) {
  constexpr double confused = 3.0;  // collinearity that explains a fall in rank by itself
  constexpr double much = 0.3;      // of the bits
  constexpr double tumbled = 5.0;   // [deg] that move the g components by a tenth and more
  const ParameterRank& p = r.parameters[state];
  if (higher_here && p.collinearity() > confused)
    return fmt::format(
        "given the singular value of one vector it takes part in; yet confused with {} "
        "(correlation {:.4f}, collinearity {:.3g})",
        key_of_state(r, p.partner), p.correlation, p.collinearity());
  if (higher_here && TermLibrary::specs[p.param].group == Name("s") && left_out.turned > 0.0)
    return "the SOM takes every position as held level, torquing all the time; the plan drifts "
           "free";
  if (higher_here)
    return fmt::format("the SOM knows no noise and no dwell; they leave {:.2g} of the prior sigma",
                       p.learning_ratio());
  const double share = left_out.on_the_way[static_cast<Eigen::Index>(state)];
  if (share > much)
    return fmt::format(
        "the SOM knows no slews and no turns of the case, which give {:.0f} % of its bits",
        100.0 * share);
  if (left_out.turned > tumbled)
    return fmt::format(
        "the SOM takes every position as held level; in free drift the Earth turns the "
        "platform by {:.0f} deg through other attitudes",
        left_out.turned);
  return TermLibrary::owner(p.param).in_rates
             ? "the SOM has no time in it: a drift of small weight there adds up over the dwells"
             : "the SOM has no averaging in it: a signal of small weight there is read in every "
               "sample";
}

std::string ham_brown_reason(const Ranking& r, std::size_t state, bool higher_here) {
  const EigenDirection& d = home_of(r, state);
  return fmt::format("judged by one direction that holds {:.1f} % of it: {}{}",
                     100.0 * d.participation(state), name_of(d, r.layout),
                     higher_here ? "; the rest lies in directions seen much worse" : "");
}

}  // namespace

VecX ranks_of(const VecX& score) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(score.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::ranges::stable_sort(order, std::greater{}, [&](Eigen::Index k) { return score[k]; });
  VecX ranks(score.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first + 1;
    const double best = score[order[first]];
    while (end < order.size() && best - score[order[end]] <= 1e-9 * std::abs(best)) ++end;
    for (std::size_t i = first; i < end; ++i)
      ranks[order[i]] = 0.5 * static_cast<double>(first + 1 + end);
    first = end;
  }
  return ranks;
}

double spearman(const VecX& a, const VecX& b) {
  const VecX x = ranks_of(a).array() - 0.5 * static_cast<double>(a.size() + 1);
  const VecX y = ranks_of(b).array() - 0.5 * static_cast<double>(b.size() + 1);
  return x.dot(y) / (x.norm() * y.norm());
}

VecX svd_degrees(const PwcsRank& pwcs) {
  const MatX& V = pwcs.V;
  const VecX weight = (V.transpose() * VecX::Ones(V.rows())).cwiseAbs();
  VecX degree(V.rows());
  for (Eigen::Index k = 0; k < V.rows(); ++k) {
    Eigen::Index i = 0;
    weight.cwiseProduct(V.row(k).transpose().cwiseAbs()).maxCoeff(&i);
    degree[k] = i < pwcs.rank ? pwcs.singular_values[i] : 0.0;
  }
  return degree.tail(V.rows() - 3) / degree.head<3>().maxCoeff();
}

VecX ham_brown(const Ranking& ranking) {
  const auto n = static_cast<Eigen::Index>(ranking.layout.size());
  VecX score(n);
  for (Eigen::Index k = 0; k < n; ++k)
    score[k] = -static_cast<double>(n) /
               (1.0 + home_of(ranking, static_cast<std::size_t>(k)).information) /
               ranking.covariance.trace();
  return score;
}

std::vector<MethodRanking> compare_methods(const Ranking& ranking, const PwcsRank& pwcs,
                                           const LinearisedPlan& plan,
                                           const InformationCourse& course,
                                           const TestPlan& positions) {
  const LeftOut missing = left_out(plan, course, positions);
  const auto n = static_cast<Eigen::Index>(ranking.layout.size());
  VecX learned(n), conditional(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const ParameterRank& p = ranking.parameters[k];
    learned[k] = -p.learning_ratio();
    conditional[k] = -p.conditional_sigma / p.prior_sigma;
  }
  std::vector<MethodRanking> all{
      {"conditional",
       "conditional sigma: all other parameters known (column norm)",
       conditional,
       0.0,
       {}},
      {"svd",
       "SVD degree of observability of the SOM, prior-scaled, positions held level",
       svd_degrees(pwcs),
       0.0,
       {}},
      {"ham_brown",
       "Ham-Brown: eigenvalue of the dominant direction",
       ham_brown(ranking),
       0.0,
       {}}};
  const VecX primary = ranks_of(learned);
  for (MethodRanking& m : all) {
    m.spearman = spearman(m.score, learned);
    const VecX here = ranks_of(m.score);
    std::vector<std::size_t> worst(static_cast<std::size_t>(n));
    std::iota(worst.begin(), worst.end(), std::size_t{0});
    std::ranges::stable_sort(worst, std::greater{},
                             [&](std::size_t k) { return std::abs(here[k] - primary[k]); });
    for (const std::size_t k : worst) {
      if (m.disagreements.size() == 3 ||
          std::abs(here[k] - primary[k]) < 0.25 * static_cast<double>(n))
        break;
      const bool higher_here = here[k] < primary[k];
      const std::string reason = m.key == "conditional"
                                     ? conditional_reason(ranking, k, higher_here)
                                 : m.key == "svd" ? svd_reason(ranking, k, higher_here, missing)
                                                  : ham_brown_reason(ranking, k, higher_here);
      m.disagreements.push_back({k, here[k], primary[k], reason});
    }
  }
  return all;
}

}  // namespace drift::observability
