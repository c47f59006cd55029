#pragma once

#include <string>
#include <vector>

#include "analysis/discovery/diagnosis.hpp"

namespace drift {

/// residual_signal.csv: the recovered inputs, row by row: equation, time [s], position, value, sigma,
/// explained (empty where no cause is named) and unit. Facts in comment lines. Not finite: an empty
/// cell.
std::string residual_signal_csv(const std::vector<discovery::RecoveredSignal>& signals);

}  // namespace drift
