#pragma once

#include <string>

#include "core/physics/drift_model.hpp"

namespace drift {

/// "eq5", as in study files.
std::string_view key_of(Coupling coupling);

/// The drift equation of a coupling, on one line.
std::string_view equation_of(Coupling coupling);

/// Keys of the terms of a model, "fixed_drift, g_drift".
std::string term_keys(const TermMask& terms);

}  // namespace drift
