#pragma once

#include <string>
#include <vector>

#include "core/recording/recording.hpp"

namespace drift::preparation {

/// Takes out of accelerometers, gimbals and covariates what a logger writes where it has read
/// nothing (999.999, 0, 85): one and the same number, to the last digit, in three rows and more of
/// two positions and more, from which every neighbour of the position is far (FillerLimits). Of a
/// number that all three accelerometers, or gimbals, read at once it is enough that one of them is
/// far from its neighbours, and of accelerometers that it is so in one position: 0, 0, 0 is no
/// specific force. Such samples become NaN, with a remark. A number that is alone is an isolated
/// sample and left to the fit.
void leave_out_fillers(Recording& recording, std::vector<std::string>& remarks);

/// Of a unit on a case, which has no positions: what its three accelerometers read at once, in
/// three rows and more, and far from their neighbours. Where its gyros read alike in such a row
/// they have not been read either. Counts that are as coarse as that are no fillers.
void leave_out_fillers_on_a_case(Recording& recording, std::vector<std::string>& remarks);

}  // namespace drift::preparation
