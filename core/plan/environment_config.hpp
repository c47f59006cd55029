#pragma once

#include "core/config/section.hpp"
#include "core/plan/environment.hpp"

namespace drift {

/// Reads [environment]; nothing is assumed where it is absent.
Environment read_environment(config::Section section);

}  // namespace drift
