#pragma once

#include <string>

#include "mc/study.hpp"

namespace drift {

/// The study file at `path` with the overrides put in, as the text of a complete TOML study file:
/// the way to write a changed study, for instance with a term added to its nominal filter. Values
/// keep their units; comments are lost. The text is not checked: read it back with read_study().
std::string study_text(const std::string& path, const Overrides& overrides);

}  // namespace drift
