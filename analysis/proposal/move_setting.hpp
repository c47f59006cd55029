#pragma once

#include "analysis/proposal/bins.hpp"

namespace drift::proposal {

/// A form with its period, time constant or width moved off the grid, to where its score is
/// largest, and how well the data know it: half of T falls by 1/2 within a sigma. Other forms as
/// they are.
Form with_setting_moved(Form form, const Instants& at, const Bins& bins,
                        const PlaceInformation& info);

}  // namespace drift::proposal
