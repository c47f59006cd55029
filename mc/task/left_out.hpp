#pragma once

#include <string_view>
#include <vector>

#include "mc/study/study.hpp"

namespace drift::mc {

/// What of the truth a filter leaves out: with the best of its estimates it is still another model
/// than the one that made the data.
struct LeftOut {
  bool equation = false;                ///< it has another drift equation
  ParamMask parameters;                 ///< sizes and noises of the truth that it does not have
  ParamMask held;                       ///< it knows them, at other values than the truth's
  ParamMask excluded;                   ///< it estimates them, with priors far from the truth's
  ParamMask smaller;                    ///< noises of terms, smaller than the truth's
  std::vector<std::string_view> noise;  ///< keys of noise and motion of the truth that it has not
  std::vector<std::string_view> smaller_keys;  ///< keys of noise that it has, but less of it

  /// The filter is right: its sigmas are not below its errors, as far as it is linear.
  bool nothing() const {
    return !equation && (parameters | held | excluded | smaller).none() && noise.empty() &&
           smaller_keys.empty();
  }
};

/// [sigma of a filter's prior] A parameter whose truths lie farther from the mean of the prior,
/// root mean square, is one that the prior excludes: normal numbers are not there.
inline constexpr double far_off_prior = 5.0;

/// Compares a filter with the truth. Of the truth counts what acts: an effect of size zero does
/// not, a drawn one does. A loop that compensates nothing is eq. (5), an integrating servo closes
/// like eq. (6), a filter that estimates lambda has every member of the family that its prior does
/// not exclude, and all of them are one unless truth and filter both have misalignments. What the
/// filter has beyond the truth harms nothing: of a noise that is larger than the truth's, its
/// sigmas are only too large.
LeftOut left_out(const TruthSpec& truth, const FilterSpec& filter);

/// The same of filter number `filter` of a study, whose plan has its part in it: Coulomb friction
/// of a servo hangs the platform off, to another side after every slew. At a caging that is part of
/// the attitude that is estimated; of what is carried along to another position it is no parameter.
LeftOut left_out(const Study& study, std::size_t filter);

/// Whether truths are drawn from what the filter believes and starts from: it leaves nothing out,
/// and coupling, priors and noise are the same, too. The mean of the error squared over the
/// covariance, both of the parameters given the data, is then 1 for each parameter, over many runs
/// and whatever the model: E[(x - m)^T P^-1 (x - m) | y] = trace(P^-1 P) for every y. A filter
/// whose NEES differs is off by its own approximation.
bool drawn_from_beliefs(const TruthSpec& truth, const FilterSpec& filter);

}  // namespace drift::mc
