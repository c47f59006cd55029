#pragma once

#include <string>
#include <vector>

#include "core/plan/readout.hpp"
#include "core/recording/recording.hpp"

namespace drift::preparation {

/// What a readout that is coarser than its noise (reading_step()) adds: a reading is off by up to
/// half a step, with a standard deviation of step / sqrt(12). Of n rows that read one value the
/// error is one and the same: as noise of each of them it is sqrt(n) times as large. Where that is
/// more than the noise that is declared it takes its place: rounding to 0.1 deg is no readout of
/// 5 arcsec.
///
/// recordings: as their files have them, before rows are joined. A mean over rows that all read one
/// value is rounded like each of them; angles are not averaged. What was taken is remarked.
void take_rounding(const std::vector<Recording>& recordings, Readout& readout,
                   std::vector<std::string>& remarks);

}  // namespace drift::preparation
