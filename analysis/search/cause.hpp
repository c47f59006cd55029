#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/stats/normal.hpp"

namespace drift::search {

/// "magnetic_drift.y"; the term alone where there is no axis.
inline std::string keyed(std::string_view term, std::string_view axis) {
  std::string key(term);
  if (!axis.empty()) key.append(".").append(axis);
  return key;
}

/// A number of a cause, in `unit`.
struct CauseParameter {
  std::string key;
  std::size_t param = 0;  ///< index in TermLibrary
  double value = 0.0, sigma = 0.0;
  std::string unit;
  bool profiled = false;  ///< nonlinear: found on a grid and refined; sigma from the profile
  /// Distance of what is told from the mean of its prior, in sigmas of that; NaN where the prior is
  /// one value.
  double prior_sigmas = std::numeric_limits<double>::quiet_NaN();
  /// 95 % interval by refits at fixed values; NaN where one of its ends is not known.
  double low_95 = std::numeric_limits<double>::quiet_NaN();
  double high_95 = std::numeric_limits<double>::quiet_NaN();
  /// Of a discrete setting: all values that hold 95 % together, where these are several.
  std::vector<double> any_of = {};
  /// Where the profile is most probable; NaN without one.
  double top = std::numeric_limits<double>::quiet_NaN();
  bool less_mean = false;  ///< less the mean of the three axes, which the test does not see
  /// With which its cause was weighed, on the library's grid; the profile may say another.
  double weighed = std::numeric_limits<double>::quiet_NaN();
  bool without_grid = false;  ///< its refits leave a setting of the cause free of that grid

  /// The 95 % interval: by refits where there is one, else by the sigma. Where refits found one end
  /// alone, without the library's grid, the other is not known (NaN); else the sigma tells it.
  bool half_open() const { return without_grid && std::isfinite(low_95) != std::isfinite(high_95); }
  bool as_refitted() const { return by_refits() || half_open(); }
  bool by_refits() const { return std::isfinite(low_95) && std::isfinite(high_95); }
  /// Whether value and sigma say as much as the ends that refits found.
  bool sigma_says_it() const {
    const bool none = !std::isfinite(low_95) && !std::isfinite(high_95);
    return none || stats::normal_says(value, sigma, low_95, high_95);
  }
  /// Whether refits say more than the sigma: then the most probable value is told. The fit may have
  /// had no noise that drives the platform, and a setting the library's grid.
  bool tells_top() const {
    const bool within = as_refitted() && std::isfinite(top) && !(top < low_95) && !(top > high_95);
    return within && !sigma_says_it();
  }
  /// The value to be told, and the sigma that belongs to it: of the farther end that refits found.
  double told() const { return tells_top() ? top : value; }
  double told_sigma() const {
    return tells_top() ? std::fmax(top - low_95, high_95 - top) / stats::half_width_95 : sigma;
  }
  double low() const { return as_refitted() ? low_95 : value - stats::half_width_95 * sigma; }
  double high() const { return as_refitted() ? high_95 : value + stats::half_width_95 * sigma; }
};

struct Confusable {
  std::string term, axis;
  double cosine = 0.0;  ///< of the two projected signatures
};

/// One cause in the answer.
struct Cause {
  std::string term;  ///< key of the library, "magnetic_drift"
  std::string axis;  ///< "y", empty if it has none or is not split
  std::vector<CauseParameter> parameters;
  double T = 0.0;  ///< projected score of `dof` degrees
  int dof = 1;
  double p_value =
      1.0;  ///< family-wise; of several simultaneous causes each with the others in the model
  double held_out_gain =
      std::numeric_limits<double>::quiet_NaN();  ///< log score that its absence costs; of
                                                 ///< simultaneous causes
  double probability = 0.0;                      ///< of its set among the sets that are listed
  double log_bayes = 0.0;              ///< log evidence for its set against the nominal model
  double log_bayes_as_declared = 0.0;  ///< the same, either under the noise that is declared
  double size_sigma = 0.0;             ///< size needed, in prior sigmas
  int set = 0;  ///< simultaneous causes share a number; alternatives have different ones
  std::vector<Confusable> confusable_with;
};

/// A candidate's line in the table: every one that was tried.
struct CandidateScore {
  std::string term, axis, label;
  int dof = 1;
  double score = 0.0;       ///< T
  double p_value = 1.0;     ///< family-wise
  double p_marginal = 1.0;  ///< of this candidate alone
  double absorbed = 0.0;    ///< part of the raw signature that fitted parameters take up, 0..1
  std::optional<std::size_t> param;  ///< index in TermLibrary, where there is only one
  double amplitude = 0.0,
         sigma = 0.0;  ///< expected parameter change and its sigma, in `unit` (one degree)
  double smallest_detectable = 0.0;  ///< amplitude found with 80 % probability, in `unit`
  double size_sigma = 0.0;           ///< amplitude over prior sigma
  double log_bayes = 0.0;            ///< log evidence against the nominal model
  double probability = 0.0;          ///< among all single candidates and nothing
  double worst_conditional = 0.0;    ///< largest p-equivalent T of others once this one is in
  bool adequate = false;             ///< nothing else is significant once it is in
  bool leaves_nothing = false;  ///< the same by the linearised test alone, whatever the refits say
  bool observable = true;
  std::string unit;
};

/// Causes with the settings of which one end alone is known as they were weighed: at the top of its
/// profile, far beyond the library's grid, an effect may be another's twin that it is not there.
inline std::vector<Cause> as_weighed(std::vector<Cause> causes) {
  for (Cause& cause : causes)
    for (CauseParameter& p : cause.parameters)
      if (p.half_open() && std::isfinite(p.weighed)) p.value = p.weighed;
  return causes;
}

}  // namespace drift::search
