#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/identification/beyond_prior.hpp"
#include "analysis/identification/filter_odds.hpp"
#include "analysis/report/identify/sections.hpp"

namespace drift::report {

/// Which filters are believed, and what stands against those that are.
struct Judgement {
  std::vector<std::string> good, bad;  ///< names; what is wrong with them
  std::vector<std::string> nearly;     ///< names of good ones that few right models fit as badly as
  std::vector<std::string> less_noise;  ///< good ones with less noise than declared, how much less
  std::vector<std::string> leave_more;  ///< the other good ones where there are such
  std::optional<identification::Favoured> favoured;  ///< some of the good ones, if any are
  bool wrong = false;       ///< a filter that fits has a parameter that is wrong
  bool unlearned = false;   ///< the first filter, which `rank` improves, lacks one that a position
                            ///< may show
  bool first_fits = false;  ///< the first filter, which `diagnose` would examine
  bool first_favoured = true;          ///< no other one is more probable
  bool first_less_noise = false;       ///< it fits with less noise than declared
  std::vector<std::string> first_far;  ///< its parameters far from their priors (far_from_prior())
};
Judgement judgement_of(const mc::Study& study, const identification::Identification& id);

/// A fit that is not a misfit may still be one that few right models have; else empty.
std::string outside_text(const FilterView& v);

/// Keys of parameters that the farthest of all parameters of right priors would be beyond with a
/// small chance alone (FitLimits::far_from_prior), the farthest first: physics that is missing,
/// another drift equation too, may be taken up by what a filter estimates, so that it fits.
std::vector<std::string> far_from_prior(const FilterView& v);
/// What parameters may be behind that no prior of the study would have where a fit takes them.
inline constexpr std::string_view behind_far_priors =
    "wrong priors, missing physics, or a study that is not of this recording (latitude, axes, unit "
    "of time)";
/// Keys that are named of such parameters, at most.
inline constexpr std::size_t most_far_named = 6;
/// Keys of such parameters, the farthest first.
std::vector<std::string> keys_of_far(std::vector<identification::BeyondPrior> far);
/// Of such parameters, or of those that no prior of the study would have there (beyond_prior());
/// empty where there is none.
struct SaidOfPriors {
  Weight weight = Weight::note;
  std::string text;
};
SaidOfPriors priors_text(const FilterView& v);

/// The latitude that explains the misfit of a filter; empty if none does.
std::optional<identification::LatitudeDoubt> other_latitude(
    const identification::Identification& id);
/// The headings that explain it.
const identification::HeadingDoubt* other_headings(const identification::Identification& id);

/// What to do next, as a command where there is one; empty where nothing is left to do.
std::string next_step(const mc::Study& study, const identification::Identification& id,
                      const Judgement& j);

}  // namespace drift::report
