#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/diagnosis/findings/diagnosis.hpp"

namespace drift::report {

/// Causes that act together are one alternative: indices into Diagnosis::causes.
using CauseIndices = std::vector<std::size_t>;

std::vector<CauseIndices> alternatives_of(const diagnosis::Diagnosis& d);

/// Its causes in words.
std::string together(const diagnosis::Diagnosis& d, const CauseIndices& causes);

/// What cannot tell things apart: "this plan", or the positions that were recorded of it.
std::string_view positions_at_hand(const diagnosis::Diagnosis& d);

/// The alternatives that no data of these positions tells apart: " (1) and (2) leave the same trace
/// on this plan."
std::string twins_text(const diagnosis::Diagnosis& d, const std::vector<CauseIndices>& all);

/// What leaves the same trace as a cause and is no part of the verdict. A candidate of all axes of
/// a term is passed over for the one axis of it that does.
std::string outside_twins_text(const diagnosis::Diagnosis& d);

}  // namespace drift::report
