#pragma once

#include <span>
#include <vector>

#include "analysis/diagnosis/findings/profile.hpp"
#include "analysis/search/cause.hpp"
#include "analysis/search/search.hpp"

namespace drift::diagnosis {

/// Whether parameters of causes are profiled: five to seven refits each, and a few more where these
/// do not hold the interval.
enum class Profiles { left_out, of_the_causes };

/// Causes beyond so many parameters are not profiled, the first ones come first.
inline constexpr std::size_t most_profiles = 8;

/// The profile of every parameter of the causes that has a sigma: refits with it held at its value
/// and 1.5 and 3 sigmas to either side, the same where another fit of the same causes ended
/// (other_valleys.hpp), of lambda at 0 and 1 too; farther out and closer
/// to the top as long as these do not hold the interval. The likelihood is that by which
/// causes are weighed, all else integrated out; the prior of the parameter counts, but not that of
/// a setting, which stands for the distance of grid points. causes: of found.sets, in their order.
std::vector<Profile> profiles_of(const search::Search& found, const MeasuredTest& test,
                                 const std::vector<search::Cause>& causes);

/// Gives the parameters of causes the intervals that were profiled, and a value that lies outside
/// its own the top of its profile. nominal: the model that lacks the causes.
void set_intervals(std::vector<search::Cause>& causes, const std::vector<Profile>& profiles,
                   const FilterSpec& nominal);

}  // namespace drift::diagnosis
