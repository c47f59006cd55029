#pragma once

#include "analysis/forms/bins.hpp"

namespace drift::forms {

/// A form with its period, time constant or width moved off the grid, to where its score is
/// largest; its sigma is half a step of the grid, so that a fit may move it on. Other forms as they
/// are.
Form with_setting_moved(Form form, const Instants& at, const Bins& bins,
                        const PlaceInformation& info);

}  // namespace drift::forms
