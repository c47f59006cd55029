#pragma once

#include "core/config/section.hpp"
#include "core/physics/own/own_term.hpp"

namespace drift {

/// Reads every [[term]]: key, title, acts_on, equation, parameters. Mistakes of an equation are
/// shown with the place in it. before: terms that there are already; those read come after them.
OwnTermSet read_own_terms(config::Section& root, OwnTermSet before = {});

}  // namespace drift
