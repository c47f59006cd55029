#pragma once

#include <string>

#include "core/physics/term_library.hpp"

namespace drift {

/// The own terms of a truth as they were drawn, for a run that fails: what grows without bounds is
/// mostly one of a study's own. "decay (decay_A = 3 mdeg/h, decay_T = -1 min)"; empty without any.
std::string own_terms_drawn(const TermMask& terms, const Theta& drawn);

}  // namespace drift
