#pragma once

#include "mc/study/study.hpp"

namespace drift::mc {

/// InputError (config), with the line of its terms, if [truth] has terms that follow what a
/// simulated recording does not carry: a temperature or a magnetic field that [environment] does
/// not declare, columns that a recording alone has; or if an own term of it is no finite number
/// somewhere on the plan. Nothing can be simulated from it.
void require_simulable_truth(const Study& study);

/// What terms of [truth] and of every filter follow, likewise: nothing that is simulated can be
/// estimated with them. Runs that an own term ends are failed ones.
void require_simulable_models(const Study& study);

/// The same of every filter, for a test that is only planned, in surroundings of which `known` is
/// all that is known; and if an own term of theirs is no finite number there.
void require_planned_filters(const Study& study, const Environment& known);

}  // namespace drift::mc
