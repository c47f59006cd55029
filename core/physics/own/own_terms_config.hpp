#pragma once

#include "core/config/section.hpp"
#include "core/physics/own/own_term.hpp"

namespace drift {

/// Reads every [[term]]: key, title, acts_on, equation, parameters. Mistakes of an equation are
/// shown with the place in it.
OwnTermSet read_own_terms(config::Section& root);

}  // namespace drift
