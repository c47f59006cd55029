#pragma once

#include "analysis/search/refine_grids.hpp"
#include "analysis/search/search.hpp"

namespace drift::search {

/// Ways to put the same causes in that a fit did not come to: an onset, or another continuous
/// setting, about which the linearised test has several valleys, ends in the one it began in. For
/// each such setting of an explanation: the settings between its own cell of the library's grid and
/// the next ones at which the evidence has a maximum of its own, best first, that explain as much
/// as the best give or take what a refit may change (ReachLimits::refine_setting). The grid must be
/// fine there (refine_about).
std::vector<Explanation> other_valleys(const Fitted& nominal, const Refit& r);

/// Whether two fits are of the same causes and came to the same settings, a tenth of a sigma apart
/// at most.
bool same_valley(const Fitted& nominal, const Refit& a, const Refit& b);

/// The continuous settings that a fit found.
std::vector<SettingFound> settings_found(const Fitted& nominal, const Refit& r);

}  // namespace drift::search
