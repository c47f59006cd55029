#pragma once

#include <optional>

#include "analysis/identification/latitude_doubt.hpp"
#include "analysis/strapdown/case_identify.hpp"

namespace drift::strapdown {

/// Asks whether the recording is of the latitude of [site]. The gyros at rest tell the Earth's rate
/// along North and about Up; where the two make the whole of it, they are those of a latitude, and
/// the first filter is fitted there, what is left of its error among the parameters. Given where
/// that is more than three prior sigmas of latitude_error off, where its evidence is stronger than
/// studies of another latitude are rare (SiteLimits::another), and where it takes away 90 % of what
/// the filter leaves above its degrees of freedom; where the gyros do not see the Earth at the
/// declared latitude and see it there, for that alone. Nothing of it is asked where the rest of the
/// latitude's error says nothing at the declared one. id: of the same recording, latitude aside.
std::optional<identification::LatitudeDoubt> latitude_doubt(const mc::Study& study,
                                                            const Recording& recording,
                                                            const CaseIdentification& id);

}  // namespace drift::strapdown
