#include <fmt/format.h>

#include <algorithm>

#include "analysis/observability/methods/method.hpp"

namespace drift::observability {
namespace {

/// What the stripped observability matrix leaves out of a plan.
struct LeftOut {
  VecX on_the_way;      ///< share of each parameter's bits that slews and turns of the case give
  double turned = 0.0;  ///< by the Earth in the longest dwell of free drift [deg]
};

LeftOut left_out(const Ranked& r) {
  const InformationCourse& course = r.course;
  LeftOut out{VecX::Zero(course.gain.rows()), 0.0};
  for (std::size_t b = 0; b < r.plan.bins.size(); ++b)
    if (r.plan.bins[b].slew) out.on_the_way += course.gain.col(static_cast<Eigen::Index>(b));
  out.on_the_way = out.on_the_way.cwiseQuotient(course.gain.rowwise().sum().cwiseMax(1e-12));
  for (const Position& p : r.positions.positions)
    if (p.mode == CommandLaw::free)
      out.turned = std::max(out.turned, detail::earth_rate * p.dwell / detail::deg);
  return out;
}

std::string svd_reason(const Ranked& r, std::size_t state, bool higher_here) {
  const LeftOut missing = left_out(r);
  constexpr double confused = 3.0;  // collinearity that explains a fall in rank by itself
  constexpr double much = 0.3;      // of the bits
  constexpr double tumbled = 5.0;   // [deg] that move the g components by a tenth and more
  const ParameterRank& p = r.parameter(state);
  if (higher_here && p.collinearity() > confused)
    return fmt::format(
        "given the singular value of one vector it takes part in; yet confused with {} "
        "(correlation {:.4f}, collinearity {:.3g})",
        TermLibrary::specs[r.ranking.layout.params[p.partner]].key.view(), p.correlation,
        p.collinearity());
  if (higher_here && TermLibrary::specs[p.param].group == Name("s") && missing.turned > 0.0)
    return "the SOM takes every position as held level, torquing all the time; the plan drifts "
           "free";
  if (higher_here)
    return fmt::format("the SOM knows no noise and no dwell; they leave {:.2g} of the prior sigma",
                       p.learning_ratio());
  const double share = missing.on_the_way[static_cast<Eigen::Index>(state)];
  if (share > much)
    return fmt::format(
        "the SOM knows no slews and no turns of the case, which give {:.0f} % of its bits",
        100.0 * share);
  if (missing.turned > tumbled)
    return fmt::format(
        "the SOM takes every position as held level; in free drift the Earth turns the "
        "platform by {:.0f} deg through other attitudes",
        missing.turned);
  return TermLibrary::owner(p.param).in_rates
             ? "the SOM has no time in it: a drift of small weight there adds up over the dwells"
             : "the SOM has no averaging in it: a signal of small weight there is read in every "
               "sample";
}

VecX svd_of(const Ranked& r) {
  return svd_degrees(r.pwcs);
}

}  // namespace

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

Method svd() {
  return {"svd", "SVD degree of observability of the SOM, prior-scaled, positions held level",
          svd_of, svd_reason};
}

}  // namespace drift::observability
