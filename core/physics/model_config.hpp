#pragma once

#include <vector>

#include "core/config/section.hpp"
#include "core/physics/model_spec.hpp"

namespace drift {

/// Whether [truth.servo] and [truth.loop] may stand beside a coupling that does not use them: only
/// in a study that sweeps the coupling.
enum class UnusedTables { refused, allowed };

/// Reads [truth]: coupling (required), terms, parameters, noise, [truth.servo], [truth.loop].
TruthSpec read_truth(config::Section section, const Mounting& mounting, UnusedTables unused);

/// Reads every [[filter]]: name, coupling (required, never servo), terms, parameters, noise,
/// starts.
std::vector<FilterSpec> read_filters(config::Section& root, const Mounting& mounting);

}  // namespace drift
