#pragma once

#include <string>

#include "analysis/diagnosis/findings/proposal.hpp"

namespace drift::report {

/// What is proposed where no known effect explains a misfit, and what that is worth.
std::string form_sentence(const diagnosis::Proposal& proposal);

}  // namespace drift::report
