#pragma once

#include <string>

#include "analysis/diagnosis/findings/diagnosis.hpp"

namespace drift::report {

/// A verdict of its own: nothing that is said of causes holds for another place on the Earth.
std::string site_text(const identification::LatitudeDoubt& doubt);

}  // namespace drift::report
