#pragma once

#include <string>
#include <vector>

#include "core/plan/readout.hpp"
#include "core/recording/recording.hpp"

namespace drift::preparation {

/// Channels of one kind that are written in steps coarser than their noise (reading_step()), and
/// the noise of the one whose rounding is worst.
struct Steps {
  std::vector<std::string> names{};
  std::string unit{};  ///< of the file
  double step = 0.0;   ///< in it
  double noise = 0.0;  ///< [g], [rad]
  std::string file{};  ///< whose it is, where another recording has much less of it; else ""
};

/// What the readouts of recordings add by being coarse.
struct Rounding {
  Steps accelerometers, gimbals;
};

/// A reading is off by up to half a step, with a standard deviation of step / sqrt(12). Of n rows
/// that read one value, or that go on by as many steps from row to row, the error is one and the
/// same: as noise of each of them it is sqrt(n) times as large, on average over the rows.
///
/// recordings: as their files have them, before rows are joined. A mean over rows that all read one
/// value is rounded like each of them; angles are not averaged.
Rounding rounding_of(const std::vector<Recording>& recordings);

/// Adds that to a noise that is declared and less: rounding to 0.1 deg is no readout of 5 arcsec. A
/// declared noise that is larger has it in it. What was taken is remarked, and of which file it is:
/// there is one readout for all recordings.
void take_rounding(const Rounding& rounding, Readout& readout, std::vector<std::string>& remarks);

}  // namespace drift::preparation
