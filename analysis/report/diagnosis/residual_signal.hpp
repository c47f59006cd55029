#pragma once

#include <string>
#include <vector>

#include "analysis/diagnosis/diagnosis.hpp"

namespace drift::report {

/// residual_signal.csv: the recovered inputs, row by row: equation, time [s], position, value,
/// sigma, explained (empty where no cause is named) and unit. Facts in comment lines. Not finite:
/// an empty cell. Of several recordings, whose times follow one another, a last column names the
/// recording; a comment line says what to subtract for its own time.
std::string residual_signal_csv(const std::vector<diagnosis::RecoveredSignal>& signals,
                                const std::vector<diagnosis::RecordingSpan>& recordings = {});

}  // namespace drift::report
