#pragma once

#include <vector>

#include "analysis/diagnosis/findings/profile.hpp"

namespace drift::diagnosis {

/// Top and interval of a profile from its points, whose losses are counted from anywhere: the top
/// by a parabola through the highest three, the interval on the signed root of the loss, which is
/// straight where the profile is a parabola. Of several valleys each counts with its depth and
/// width, exp(-loss/2) times its own interval, and the interval is from the lowest to the highest
/// end of those that hold 95 % together. At least three points with different values.
Profile with_interval(Profile profile);

/// Where a profile with an interval wants further points: `outward` beyond the points where an end
/// of it was not found, and in every valley that may count half way to a neighbour of its top that
/// lies beyond the valley already and at an end that was interpolated over a long way.
std::vector<double> wanted_points(const Profile& profile, double outward);

}  // namespace drift::diagnosis
